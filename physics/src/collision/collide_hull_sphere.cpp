#include "collision/closest_on_hull.h"
#include "collision/collide_pairs.h"

namespace tweenfall::collision {

using shapes::Placed;

Manifold collide(const Hull& a, const Placed& at_a, const Sphere& b, const Placed& at_b, double margin) {
  const Vec3 center = at_a.axes.transpose() * (at_b.center - at_a.center);
  const ClosestOnHull closest = closest_on_hull(a.convex, center);
  const bool outside = closest.distance > 1e-12 * a.convex.outer_radius();
  Manifold manifold;
  manifold.normal = outside ? Vec3((center - closest.point) / closest.distance) : a.convex.faces()[closest.face].normal;
  const double penetration = b.radius - closest.distance;
  add_point(manifold, center - manifold.normal * (b.radius - 0.5 * penetration), penetration, 0, margin);
  return to_world(manifold, at_a);
}

}  // namespace tweenfall::collision
