#pragma once

// The objects of an FBX file, their properties, and their connections.

#include "fbx/records/records.h"
#include "model/model_problems.h"

#include <tweenfall/curves/values.h>

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace tweenfall::fbx {

struct Object {
  std::int64_t id = 0;
  std::string_view kind;  ///< "Model", "Geometry", "AnimationCurve", ...
  std::string_view form;  ///< "Mesh", "LimbNode", "Skin", ...
  std::string name;       ///< as shown to people
  const Record* record = nullptr;
  const Record* properties = nullptr;  ///< null for none
  const Record* defaults = nullptr;    ///< the properties of its kind's template, null for none
};

/// One object is attached to another, or drives a property of it.
struct Connection {
  std::size_t from = 0, to = 0;  ///< indices in the list of objects
  std::string_view property;     ///< of `to`; empty for the whole object
};

class Objects {
 public:
  /// `file` and `source` must outlive this. @throws ModelError
  Objects(const File& file, const Source& source, models::ModelProblems& problems);

  [[nodiscard]] const std::vector<Object>& all() const { return objects_; }
  [[nodiscard]] const Object& operator[](std::size_t index) const { return objects_[index]; }

  /// Objects connected to `to` as a whole, in the file's order, of one kind and, unless empty, one form.
  [[nodiscard]] std::vector<std::size_t> below(std::size_t to, std::string_view kind, std::string_view form = {}) const;
  /// Objects to which `from` is connected as a whole, likewise.
  [[nodiscard]] std::vector<std::size_t> above(std::size_t from, std::string_view kind,
                                               std::string_view form = {}) const;
  [[nodiscard]] std::vector<Connection> to(std::size_t object) const { return listed(to_, object); }
  [[nodiscard]] std::vector<Connection> from(std::size_t object) const { return listed(from_, object); }

  /// The record of a property, the object's own or its template's; null for none.
  [[nodiscard]] const Record* property(const Object& object, std::string_view name) const;
  [[nodiscard]] Vec3 vector(const Object& object, std::string_view name, const Vec3& otherwise) const;
  [[nodiscard]] double number(const Object& object, std::string_view name, double otherwise) const;
  [[nodiscard]] std::int64_t whole(const Object& object, std::string_view name, std::int64_t otherwise) const;

  [[nodiscard]] const Source& source() const { return source_; }
  /// Ticks of the file's clock per second.
  [[nodiscard]] double ticks() const { return ticks_; }
  [[nodiscard]] std::int64_t version() const { return version_; }

 private:
  void read_objects(const File& file, models::ModelProblems& problems);
  void read_connections(const File& file);
  [[nodiscard]] std::vector<Connection> listed(const std::vector<std::vector<std::size_t>>& lists,
                                               std::size_t object) const;

  const Source& source_;
  std::int64_t version_;
  double ticks_;
  std::vector<Object> objects_;
  std::unordered_map<std::int64_t, std::size_t> by_id_;
  std::vector<Connection> connections_;
  std::vector<std::vector<std::size_t>> to_, from_;
};

}  // namespace tweenfall::fbx
