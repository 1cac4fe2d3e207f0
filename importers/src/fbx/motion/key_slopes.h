#pragma once

// The slopes and handle lengths of an FBX curve's keys, as stated in the file or chosen by rules.

#include <cstdint>
#include <vector>

namespace tweenfall::fbx {

/// The flags of a key of an FBX curve. Source: Autodesk, FBX SDK, FbxAnimCurveDef; the numbers as found by ufbx.
enum KeyFlags : std::uint32_t {
  key_constant = 0x2,
  key_linear = 0x4,
  key_cubic = 0x8,
  key_constant_next = 0x100,  // with key_constant: the next key's value
  key_tcb = 0x200,
  key_user = 0x400,
  key_clamp = 0x1000,
  key_time_independent = 0x2000,
  key_clamp_progressive = 0x4000,
  key_weighted_right = 0x1000000,
  key_weighted_next_left = 0x2000000,
};

struct FileKey {
  double time = 0;   ///< s
  double value = 0;  ///< the file's unit U
  std::uint32_t flags = key_linear;
  float data[4]{};                   ///< right slope, next left slope, packed weights; or tension, continuity, bias
  std::uint32_t packed_weights = 0;  ///< the bits of data[2]
};

/// How the curve leaves a key and arrives at it.
struct KeySlopes {
  double in = 0, out = 0;                            ///< U/s
  double in_weight = 1.0 / 3, out_weight = 1.0 / 3;  ///< handles' shares of their spans
};

/// One for each key. Precondition: times strictly increase.
[[nodiscard]] std::vector<KeySlopes> key_slopes(const std::vector<FileKey>& keys);

}  // namespace tweenfall::fbx
