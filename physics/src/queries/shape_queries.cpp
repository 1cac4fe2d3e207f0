#include <tweenfall/physics/query.h>

#include <stdexcept>
#include <string>

#include "queries/checked.h"
#include "queries/closest.h"
#include "queries/rays.h"
#include "queries/sweep.h"

namespace tweenfall {

std::optional<RayHit> cast_ray(const Shape& shape, const Pose& pose, const Vec3& from, const Vec3& direction,
                               double length) {
  queries::require_place(pose);
  return queries::first_on_ray(shape, pose, queries::checked_ray(from, direction, length));
}

std::optional<ShapeHit> cast_shape(const Shape& moving, const Pose& start, const Vec3& displacement, const Shape& shape,
                                   const Pose& pose) {
  queries::require_pair(moving, start, shape, pose);
  queries::require_finite(displacement, "a displacement");
  return queries::first_on_way(moving, start, displacement, shape, pose);
}

Separation distance(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b) {
  queries::require_pair(a, pose_a, b, pose_b);
  const queries::Closest closest = queries::closest_between(a, pose_a, b, pose_b);
  return {std::max(0.0, closest.gap), closest.on_a, closest.on_b};
}

bool overlapping(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b) {
  queries::require_pair(a, pose_a, b, pose_b);
  return !(queries::closest_between(a, pose_a, b, pose_b).gap > 0);
}

Vec3 closest_point(const Shape& shape, const Pose& pose, const Vec3& point) {
  queries::require_place(pose);
  queries::require_finite(point, "a point");
  return queries::nearest_to(shape, pose, point).on_b;
}

}  // namespace tweenfall
