#pragma once

#include <tweenfall/physics/convex_hull.h>

namespace tweenfall::collision {

/// The place on a hull's surface nearest to a point.
struct ClosestOnHull {
  Vec3 point{0, 0, 0};
  double distance = 0;     ///< m; negative inside the hull: how deep below `face`
  std::uint32_t face = 0;  ///< the place lies on it, or on its border
};

/// Inside, the face with the shortest way out; a near tie goes to the first, so that it stays there.
[[nodiscard]] ClosestOnHull closest_on_hull(const ConvexHull& hull, const Vec3& point);

}  // namespace tweenfall::collision
