#include "gltf/write/buffer_writer.h"

#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace tweenfall::gltf {

std::size_t parts_of(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  if (type == "MAT4") return 16;
  return 4;
}

template <class Number>
std::size_t BufferWriter::add(const std::vector<Number>& numbers, int component, const std::string& type, int target) {
  // Vertex attributes are aligned to four bytes, which suits every component type.
  bytes_.resize((bytes_.size() + 3) / 4 * 4);
  const std::size_t offset = bytes_.size(), length = numbers.size() * sizeof(Number);
  bytes_.resize(offset + length);
  if (length) std::memcpy(bytes_.data() + offset, numbers.data(), length);
  views_.push_back({offset, length, target});
  accessors_.push_back({component, numbers.size() / parts_of(type), type, {}, {}});
  return accessors_.size() - 1;
}

std::size_t BufferWriter::add_floats(const std::vector<double>& numbers, const std::string& type, bool with_bounds,
                                     int target) {
  std::vector<float> floats;
  floats.reserve(numbers.size());
  for (const double number : numbers) {
    floats.push_back(static_cast<float>(number));
    if (!std::isfinite(floats.back()))
      throw std::runtime_error("a number does not fit glTF's 32-bit floats: " + number_text(number));
  }
  const std::size_t accessor = add(floats, float_component, type, target);
  if (with_bounds) {
    const std::size_t parts = parts_of(type);
    std::vector<float> low(floats.begin(), floats.begin() + static_cast<std::ptrdiff_t>(parts)), high = low;
    for (std::size_t i = 0; i < floats.size(); ++i) {
      low[i % parts] = std::min(low[i % parts], floats[i]);
      high[i % parts] = std::max(high[i % parts], floats[i]);
    }
    accessors_.back().low = std::move(low);
    accessors_.back().high = std::move(high);
  }
  return accessor;
}

std::size_t BufferWriter::add_indices(const std::vector<std::uint32_t>& indices, std::size_t vertex_count) {
  // The largest value of a type is reserved for primitive restart.
  if (vertex_count > 0xFFFF) return add(indices, unsigned_int_component, "SCALAR", index_target);
  const std::vector<std::uint16_t> narrow(indices.begin(), indices.end());
  return add(narrow, unsigned_short_component, "SCALAR", index_target);
}

std::size_t BufferWriter::add_joints(const std::vector<std::uint32_t>& joints, std::size_t joint_count) {
  if (joint_count > 0x100) {
    const std::vector<std::uint16_t> wide(joints.begin(), joints.end());
    return add(wide, unsigned_short_component, "VEC4", vertex_target);
  }
  const std::vector<std::uint8_t> narrow(joints.begin(), joints.end());
  return add(narrow, unsigned_byte_component, "VEC4", vertex_target);
}

std::size_t BufferWriter::add_times(const std::vector<double>& times) {
  const auto known = times_.find(times);
  if (known != times_.end()) return known->second;
  const std::size_t accessor = add_floats(times, "SCALAR", true);
  times_.emplace(times, accessor);
  return accessor;
}

void BufferWriter::finish() {
  bytes_.resize((bytes_.size() + 3) / 4 * 4);
}

}  // namespace tweenfall::gltf
