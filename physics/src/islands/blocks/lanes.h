#pragma once

/// Eight doubles side by side, as they lie in memory: one for each of eight pairs of bodies.

#include <cstdint>

namespace tweenfall::blocks {

constexpr int lane_count = 8;

/// One value per lane.
template <class Thing>
struct alignas(64) InLanes {
  Thing lanes[lane_count];

  Thing& operator[](std::int64_t lane) { return lanes[lane]; }
  const Thing& operator[](std::int64_t lane) const { return lanes[lane]; }
};
using Lanes = InLanes<double>;
using Mask = InLanes<std::int64_t>;  ///< -1 or 0

/// The same value in all lanes.
[[nodiscard]] constexpr Lanes all(double value) {
  return {{value, value, value, value, value, value, value, value}};
}

struct Lanes3 {
  Lanes x, y, z;
};

struct LanesSymmetric {
  Lanes xx, yy, zz, xy, xz, yz;
};

}  // namespace tweenfall::blocks
