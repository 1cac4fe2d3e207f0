#pragma once

/// Poses of a crowd: eight joints side by side, in float.
///
/// A pose is a list of groups. Joint `j` is lane `j % 8` of group `j / 8`; lanes after the last joint exist, but are
/// meaningless. The layout suits the vector instructions of processors.

#include <cstddef>
#include <span>

namespace tweenfall {

/// Eight joints, each relative to its parent.
struct alignas(32) CrowdGroup {
  static constexpr std::size_t size = 8;
  float translation[3][size];  ///< m
  float rotation[4][size];     ///< unit quaternions: x, y, z, w
  float scale[3][size];
};

/// The rates of a group.
struct alignas(32) CrowdRates {
  float linear[3][CrowdGroup::size];   ///< m/s
  float angular[3][CrowdGroup::size];  ///< rad/s, in the axes of the parent
  float scale[3][CrowdGroup::size];    ///< 1/s
};

/// The number of groups needed for a number of joints.
[[nodiscard]] constexpr std::size_t crowd_groups(std::size_t joints) noexcept {
  return (joints + CrowdGroup::size - 1) / CrowdGroup::size;
}

}  // namespace tweenfall
