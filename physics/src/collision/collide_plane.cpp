#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "collision/collide_pairs.h"
#include "pairs/contact_candidates.h"

namespace tweenfall::collision {

using shapes::Placed;

namespace {

struct WorldPlane {
  Vec3 normal;
  double offset;
};

WorldPlane in_world(const Plane& plane, const Placed& at) {
  const Vec3 normal = at.axes * plane.normal;
  return {normal, normal.dot(at.center) + plane.offset};
}

/// A ball of the given center against the plane.
void add_ball(Manifold& manifold, const WorldPlane& plane, const Vec3& center, double radius, std::uint32_t feature,
              double margin) {
  const double gap = plane.normal.dot(center) - plane.offset - radius;
  add_point(manifold, center - plane.normal * (radius + 0.5 * gap), -gap, feature, margin);
}

}  // namespace

Manifold collide(const Sphere& a, const Placed& at_a, const Plane& b, const Placed& at_b, double margin) {
  const WorldPlane plane = in_world(b, at_b);
  Manifold manifold;
  manifold.normal = -plane.normal;
  add_ball(manifold, plane, at_a.center, a.radius, 0, margin);
  return manifold;
}

Manifold collide(const Capsule& a, const Placed& at_a, const Plane& b, const Placed& at_b, double margin) {
  const WorldPlane plane = in_world(b, at_b);
  Manifold manifold;
  manifold.normal = -plane.normal;
  const Vec3 arm = a.half_height * at_a.axes.col(1);
  add_ball(manifold, plane, at_a.center - arm, a.radius, 0, margin);
  if (a.half_height > 0) add_ball(manifold, plane, at_a.center + arm, a.radius, 1, margin);
  return manifold;
}

Manifold collide(const Box& a, const Placed& at_a, const Plane& b, const Placed& at_b, double margin) {
  const WorldPlane plane = in_world(b, at_b);
  Manifold manifold;
  manifold.normal = -plane.normal;
  struct Corner {
    Vec3 position;
    double gap;
    std::uint32_t number;
  };
  std::array<Corner, 8> corners;
  for (std::uint32_t i = 0; i < 8; ++i) {
    const Vec3 sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    const Vec3 position = at_a.center + at_a.axes * sign.cwiseProduct(a.half_extents);
    corners[i] = {position, plane.normal.dot(position) - plane.offset, i};
  }
  // The four deepest; equal ones by number, so that the choice is the same every step.
  std::sort(corners.begin(), corners.end(), [](const Corner& left, const Corner& right) {
    return left.gap != right.gap ? left.gap < right.gap : left.number < right.number;
  });
  std::sort(corners.begin(), corners.begin() + 4,
            [](const Corner& left, const Corner& right) { return left.number < right.number; });
  for (int i = 0; i < 4; ++i) {
    const Corner& corner = corners[static_cast<std::size_t>(i)];
    add_point(manifold, corner.position - 0.5 * corner.gap * plane.normal, -corner.gap, corner.number, margin);
  }
  return manifold;
}

Manifold collide(const Hull& a, const Placed& at_a, const Plane& b, const Placed& at_b, double margin) {
  const WorldPlane plane = in_world(b, at_b);
  Manifold manifold;
  manifold.normal = -plane.normal;
  const std::span<const Vec3> vertices = a.convex.vertices();
  std::array<pairs::ContactCandidate, ConvexHull::most_vertices> corners;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    const Vec3 position = at_a.center + at_a.axes * vertices[i];
    corners[i] = {position, plane.normal.dot(position) - plane.offset, i};
    least = std::min(least, corners[i].gap);
  }
  // Corners much higher than the lowest belong to the hull's other side, not to the one it stands on.
  const double highest = std::min(margin, least + a.convex.inner_radius());
  std::size_t count = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (corners[i].gap <= highest) corners[count++] = corners[i];
  const Vec3 leaning = at_a.axes * Vec3(1, 0.61, 0.37);
  count = pairs::reduce_to_four(std::span(corners).first(count), plane.normal, leaning);
  for (std::size_t i = 0; i < count; ++i)
    add_point(manifold, corners[i].position - 0.5 * corners[i].gap * plane.normal, -corners[i].gap, corners[i].feature,
              margin);
  return manifold;
}

}  // namespace tweenfall::collision
