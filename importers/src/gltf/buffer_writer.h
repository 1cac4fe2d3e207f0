#pragma once

// The binary half of a glTF file as it grows: accessors over one buffer.

#include "format.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tweenfall::gltf {

class BufferWriter {
 public:
  /// An accessor of floats. @param type  "SCALAR", "VEC3", ...  @param target  0 for none
  /// @throws std::runtime_error when a number does not fit a float.
  std::size_t add_floats(const std::vector<double>& numbers, const std::string& type, bool with_bounds = false,
                         int target = 0);

  /// An accessor of unsigned integers in the smallest allowed component type.
  std::size_t add_indices(const std::vector<std::uint32_t>& indices, std::size_t vertex_count);
  std::size_t add_joints(const std::vector<std::uint32_t>& joints, std::size_t joint_count);

  /// As `add_floats` of strictly increasing times with bounds; equal lists share one accessor.
  std::size_t add_times(const std::vector<double>& times);

  [[nodiscard]] const std::vector<unsigned char>& bytes() const { return bytes_; }

  /// Puts "buffers", "bufferViews" and "accessors" into the document.
  void finish(nlohmann::json& document);

 private:
  template <class Number>
  std::size_t add(const std::vector<Number>& numbers, int component, const std::string& type, int target);

  std::vector<unsigned char> bytes_;
  nlohmann::json views_ = nlohmann::json::array();
  nlohmann::json accessors_ = nlohmann::json::array();
  std::map<std::vector<double>, std::size_t> times_;
};

/// Numbers in one element of an accessor type.
[[nodiscard]] std::size_t parts_of(const std::string& type);

}  // namespace tweenfall::gltf
