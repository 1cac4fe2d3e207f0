#pragma once

#include "queries/core.h"

namespace tweenfall::queries {

/// Where two solids are nearest to each other.
struct Closest {
  double gap = 0;                     ///< m; not positive if they touch or overlap
  Vec3 normal{0, 1, 0};               ///< unit, from a toward b; meaningless if the cores overlap
  Vec3 on_a{0, 0, 0}, on_b{0, 0, 0};  ///< on the surfaces; one common point if they touch or overlap
  double core_distance = 0;           ///< without the skins, m: the shorter it is, the less exact is the normal
};

[[nodiscard]] Closest closest_between(const Core& a, const Core& b);
/// A plane, placed in the world, which is a, and a solid.
[[nodiscard]] Closest closest_to_plane(const Plane& plane, const shapes::Placed& at, const Core& b);
/// Any two shapes except two planes.
[[nodiscard]] Closest closest_between(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b);
/// A point, which is a, and a shape, which is b.
[[nodiscard]] Closest nearest_to(const Shape& shape, const Pose& pose, const Vec3& point);

}  // namespace tweenfall::queries
