#pragma once

#include <tweenfall/physics/shape.h>

namespace tweenfall::shapes {

/// The part of a solid that is under a plane.
struct Submerged {
  double volume = 0;     ///< m^3
  Vec3 center{0, 0, 0};  ///< its middle, node axes, m
  double share = 0;      ///< of the solid's volume, 0 to 1
};

/// @param normal  unit, node axes: what is under has normal . x < level
[[nodiscard]] Submerged submerged(const Shape& shape, const Vec3& normal, double level);

/// Of a solid of revolution about y, whose squared radius is a polynomial of second degree between `low` and `high`.
struct Round {
  double low, high;
  double constant, linear, quadratic;  ///< of the squared radius, by the height
};
/// @return volume and first moments of what is under
struct Moments {
  double volume = 0;
  Vec3 first{0, 0, 0};  ///< m^4
};
[[nodiscard]] Moments submerged(const Round& round, const Vec3& normal, double level);

}  // namespace tweenfall::shapes
