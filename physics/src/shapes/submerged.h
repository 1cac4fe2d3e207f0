#pragma once

#include <tweenfall/physics/shape.h>

namespace tweenfall::shapes {

/// The part of a solid that is below a plane.
struct Submerged {
  double volume = 0;     ///< m^3
  Vec3 center{0, 0, 0};  ///< its centroid, node axes, m
  double share = 0;      ///< of the solid's volume, 0 to 1
};

/// @param normal  unit, node axes: the submerged part has normal . x < level
[[nodiscard]] Submerged submerged(const Shape& shape, const Vec3& normal, double level);

/// A solid of revolution about y, whose squared radius is a quadratic of the height between `low` and `high`.
struct Round {
  double low, high;
  double constant, linear, quadratic;  ///< of the squared radius, by powers of the height
};
/// Volume and first moments of the submerged part.
struct Moments {
  double volume = 0;
  Vec3 first{0, 0, 0};  ///< m^4
};
[[nodiscard]] Moments submerged(const Round& round, const Vec3& normal, double level);

}  // namespace tweenfall::shapes
