#include <algorithm>
#include <cmath>

#include "collision/collide_pairs.h"

namespace tweenfall::collision {

using shapes::Placed;

Manifold collide_balls(const Vec3& center_a, double radius_a, const Vec3& center_b, double radius_b,
                       const Vec3& fallback_normal, std::uint32_t feature, double margin) {
  Manifold manifold;
  const Vec3 between = center_b - center_a;
  const double distance = between.norm();
  manifold.normal = distance > 0 ? Vec3(between / distance) : fallback_normal;
  const double penetration = radius_a + radius_b - distance;
  const Vec3 middle = center_a + manifold.normal * (radius_a - 0.5 * penetration);
  add_point(manifold, middle, penetration, feature, margin);
  return manifold;
}

Manifold collide(const Sphere& a, const Placed& at_a, const Sphere& b, const Placed& at_b, double margin) {
  return collide_balls(at_a.center, a.radius, at_b.center, b.radius, Vec3(0, 1, 0), 0, margin);
}

Manifold collide(const Sphere& a, const Placed& at_a, const Capsule& b, const Placed& at_b, double margin) {
  const Vec3 axis = at_b.axes.col(1);
  const double along = std::clamp((at_a.center - at_b.center).dot(axis), -b.half_height, b.half_height);
  return collide_balls(at_a.center, a.radius, at_b.center + along * axis, b.radius, at_b.axes.col(0), 0, margin);
}

Manifold collide(const Sphere& a, const Placed& at_a, const Box& b, const Placed& at_b, double margin) {
  const Vec3 local = at_b.axes.transpose() * (at_a.center - at_b.center);
  const Vec3 closest = local.cwiseMax(-b.half_extents).cwiseMin(b.half_extents);
  const double distance = (local - closest).norm();
  // Below this the direction from the surface is mere rounding.
  const double tiny = 1e-12 * b.half_extents.maxCoeff();
  if (distance > tiny) {
    return collide_balls(at_a.center, a.radius, at_b.center + at_b.axes * closest, 0, Vec3(0, 1, 0), 0, margin);
  }
  // The center is inside: out through the nearest face; a near tie goes to the first axis, so that the choice is
  // stable.
  int face = 0;
  const Vec3 depth = b.half_extents - local.cwiseAbs();
  for (int i = 1; i < 3; ++i)
    if (depth[i] < depth[face] - 1e-9 * b.half_extents.maxCoeff()) face = i;
  const double side = local[face] < 0 ? -1 : 1;
  Manifold manifold;
  manifold.normal = -side * at_b.axes.col(face);
  const double penetration = a.radius + depth[face];
  add_point(manifold, at_a.center + manifold.normal * (a.radius - 0.5 * penetration), penetration, 0, margin);
  return manifold;
}

}  // namespace tweenfall::collision
