#pragma once

// The binary part of a glTF file while it is written: accessors over one buffer.

#include "gltf/format.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tweenfall::gltf {

/// A stretch of the buffer.
struct BufferView {
  std::size_t offset = 0, length = 0;  ///< bytes
  int target = 0;                      ///< a `BufferTarget`, or 0 for none
};

/// The whole buffer view of the same index, as elements.
struct Accessor {
  int component = 0;  ///< a `ComponentType`
  std::size_t count = 0;
  std::string type;
  std::vector<float> low, high;  ///< bounds of each part, or empty
};

class BufferWriter {
 public:
  /// An accessor of floats. @param type  "SCALAR", "VEC3", ...  @param target  0 for none
  /// @throws std::runtime_error when a number does not fit a float.
  std::size_t add_floats(const std::vector<double>& numbers, const std::string& type, bool with_bounds = false,
                         int target = 0);

  /// An accessor of unsigned integers in the smallest allowed component type.
  std::size_t add_indices(const std::vector<std::uint32_t>& indices, std::size_t vertex_count);
  std::size_t add_joints(const std::vector<std::uint32_t>& joints, std::size_t joint_count);

  /// As `add_floats` with bounds, for strictly increasing times; equal lists share one accessor.
  std::size_t add_times(const std::vector<double>& times);

  /// Pads to a multiple of four bytes, as required for a chunk of a binary file; the last call.
  void finish();

  [[nodiscard]] const std::vector<unsigned char>& bytes() const { return bytes_; }
  [[nodiscard]] const std::vector<BufferView>& views() const { return views_; }
  [[nodiscard]] const std::vector<Accessor>& accessors() const { return accessors_; }

 private:
  template <class Number>
  std::size_t add(const std::vector<Number>& numbers, int component, const std::string& type, int target);

  std::vector<unsigned char> bytes_;
  std::vector<BufferView> views_;
  std::vector<Accessor> accessors_;  ///< one for each view
  std::map<std::vector<double>, std::size_t> times_;
};

/// Numbers in one element of an accessor type.
[[nodiscard]] std::size_t parts_of(const std::string& type);

}  // namespace tweenfall::gltf
