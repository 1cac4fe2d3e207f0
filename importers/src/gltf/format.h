#pragma once

// Numbers that the glTF 2.0 specification fixes, shared by reader and writer.
// Source: Khronos Group, glTF 2.0 Specification, 2021, sections 3.6.2 (accessors), 3.7.2 (meshes), 4.4 (binary glTF).

#include <cstdint>

namespace tweenfall::gltf {

inline constexpr std::uint32_t glb_magic = 0x46546C67;   // "glTF"
inline constexpr std::uint32_t json_chunk = 0x4E4F534A;  // "JSON"
inline constexpr std::uint32_t bin_chunk = 0x004E4942;   // "BIN"

enum ComponentType : int {
  byte_component = 5120,
  unsigned_byte_component = 5121,
  short_component = 5122,
  unsigned_short_component = 5123,
  unsigned_int_component = 5125,
  float_component = 5126,
};

enum BufferTarget : int { vertex_target = 34962, index_target = 34963 };

enum PrimitiveMode : int { points = 0, lines = 1, line_loop = 2, line_strip = 3, triangles = 4, strip = 5, fan = 6 };

}  // namespace tweenfall::gltf
