#pragma once

// Typed access to the fields of a glTF document: a field of the wrong type is a problem with its place, not a crash.

#include "json/json_tree.h"
#include "model/model_problems.h"

#include <optional>
#include <string>
#include <vector>

namespace tweenfall::gltf {

class Fields {
 public:
  /// @param object  must be an object; anything else is a problem and reads as empty
  Fields(const json::Value& object, std::string place, models::ModelProblems& problems);

  [[nodiscard]] const std::string& place() const { return place_; }
  [[nodiscard]] std::string place_of(const std::string& name) const { return place_ + "/" + name; }
  [[nodiscard]] bool has(const char* name) const { return static_cast<bool>(find(name)); }

  /// The field, of any type; none when absent.
  [[nodiscard]] json::Value find(const char* name) const { return object_.find(name); }

  /// A whole number >= 0; empty when absent or wrong.
  [[nodiscard]] std::optional<std::size_t> whole(const char* name) const;
  /// The same, below `count`, the length of the list it points into.
  [[nodiscard]] std::optional<std::size_t> index(const char* name, std::size_t count) const;
  /// As `index`, and a problem when absent.
  [[nodiscard]] std::optional<std::size_t> required_index(const char* name, std::size_t count) const;
  [[nodiscard]] std::string text(const char* name, const std::string& otherwise = {}) const;
  [[nodiscard]] bool flag(const char* name) const;
  /// A list of `count` finite numbers (any count for 0); empty when absent or wrong.
  [[nodiscard]] std::vector<double> numbers(const char* name, std::size_t count) const;
  /// A list of indices below `limit`; invalid ones are problems and left out.
  [[nodiscard]] std::vector<std::size_t> indices(const char* name, std::size_t limit) const;
  /// A list; an empty one when absent or wrong.
  [[nodiscard]] json::Items list(const char* name) const;
  /// An object inside; an empty one when absent.
  [[nodiscard]] Fields inside(const char* name) const;
  /// An object of a list.
  [[nodiscard]] Fields at(const char* name, std::size_t position) const;

  [[nodiscard]] models::ModelProblems& problems() const { return *problems_; }

 private:
  std::optional<std::size_t> index_value(const json::Value& value, const std::string& place, std::size_t count) const;

  json::Value object_;
  std::string place_;
  models::ModelProblems* problems_;
};

}  // namespace tweenfall::gltf
