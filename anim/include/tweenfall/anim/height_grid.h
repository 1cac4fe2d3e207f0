#pragma once

/// A ground told as heights over an even grid, smooth between them: what feet are placed on.

#include <tweenfall/anim/foot_placement.h>

#include <cstddef>
#include <string>
#include <vector>

namespace tweenfall {

/// Between the heights lies the surface of Catmull and Rom: through every height, without an edge, so that what stands
/// on it tilts without a jump. Beyond its border the ground goes straight on. Plain values.
struct HeightGrid {
  std::size_t columns = 0;      ///< heights along x; >= 2
  std::vector<double> heights;  ///< one after the other along x, row after row along z; two rows at least, m
  double spacing_x = 1;         ///< from one to the next, m; > 0
  double spacing_z = 1;
  Vec3 middle{0, 0, 0};  ///< of the grid in the world, from which heights count, m

  /// All that is wrong with it; of a grid with nothing wrong the ground may be asked.
  [[nodiscard]] std::vector<std::string> problems() const;

  /// The ground below or above a place that moves.
  [[nodiscard]] Ground at(const Sample<Vec3>& place) const noexcept;
};

}  // namespace tweenfall
