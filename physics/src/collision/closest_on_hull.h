#pragma once

#include <tweenfall/physics/convex_hull.h>

namespace tweenfall::collision {

/// The point on a hull's surface nearest to a given point.
struct ClosestOnHull {
  Vec3 point{0, 0, 0};
  double distance = 0;     ///< m; negative inside the hull: minus the depth below `face`
  std::uint32_t face = 0;  ///< the point lies on it, or on its border
};

/// Inside, the face with the shortest way out; a near tie goes to the first, so that the choice does not change.
[[nodiscard]] ClosestOnHull closest_on_hull(const ConvexHull& hull, const Vec3& point);

}  // namespace tweenfall::collision
