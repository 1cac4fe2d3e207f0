#pragma once

/// A ground for feet, given as heights on a regular grid and smooth between them.

#include <tweenfall/anim/foot_placement.h>

#include <cstddef>
#include <string>
#include <vector>

namespace tweenfall {

/// Between the heights lies a Catmull-Rom surface: through every height, without an edge, so that feet on it tilt
/// without a jump. Beyond its border the ground continues straight. Plain values.
struct HeightGrid {
  std::size_t columns = 0;      ///< heights along x; >= 2
  std::vector<double> heights;  ///< one after the other along x, row after row along z; two rows at least, m
  double spacing_x = 1;         ///< distance between neighbors, m; > 0
  double spacing_z = 1;
  Vec3 middle{0, 0, 0};  ///< of the grid in the world, m; heights are relative to it

  /// All that is wrong with it; `at` may be called only if there is nothing.
  [[nodiscard]] std::vector<std::string> problems() const;

  /// The ground below or above a moving place.
  [[nodiscard]] Ground at(const Sample<Vec3>& place) const noexcept;
};

}  // namespace tweenfall
