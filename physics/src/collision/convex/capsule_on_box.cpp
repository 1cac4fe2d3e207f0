#include "collision/convex/capsule_on_box.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "collision/collide_pairs.h"

namespace tweenfall::convex {

std::optional<Manifold> capsule_on_box(const Capsule& capsule, const shapes::Placed& at_capsule, const Box& box,
                                       const shapes::Placed& at_box, double margin, double reach) {
  if (std::isinf(margin)) return std::nullopt;
  const Mat3 into = at_box.axes.transpose();
  const Vec3 middle = into * (at_capsule.center - at_box.center);
  const Vec3 half = into * Vec3(capsule.half_height * at_capsule.axes.col(1));
  const std::array<Vec3, 2> ends = {middle - half, middle + half};
  const auto beyond = [&](int axis, double side) {
    return std::min(side * ends[0][axis], side * ends[1][axis]) - box.half_extents[axis];
  };
  int axis = -1;
  double side = 0;
  for (int i = 0; i < 3; ++i) {
    const double its = middle[i] < 0 ? -1 : 1;
    if (beyond(i, its) > 0) {
      if (axis >= 0) return std::nullopt;
      axis = i;
      side = its;
    } else if (!(std::max(std::abs(ends[0][i]), std::abs(ends[1][i])) <= box.half_extents[i])) {
      return std::nullopt;
    }
  }
  if (axis < 0) return std::nullopt;
  Manifold manifold;
  manifold.normal = side * at_box.axes.col(axis);
  if (beyond(axis, side) - capsule.radius > margin) return manifold;
  for (std::uint32_t i = 0; i < (capsule.half_height > 0 ? 2u : 1u); ++i) {
    const double gap = side * ends[i][axis] - box.half_extents[axis] - capsule.radius;
    const Vec3 lowest = at_box.center + at_box.axes * ends[i] - capsule.radius * manifold.normal;
    collision::add_point(manifold, lowest - 0.5 * gap * manifold.normal, -gap, i, reach);
  }
  return manifold;
}

}  // namespace tweenfall::convex
