#include "collision/closest_on_hull.h"

#include <algorithm>
#include <limits>

namespace tweenfall::collision {

namespace {

/// The point on a face nearest to a point at some height above its plane.
Vec3 closest_on_face(const ConvexHull& hull, const ConvexHull::Face& face, const Vec3& point, double height) {
  const Vec3 below = point - height * face.normal;
  const std::span<const std::uint32_t> corners = hull.corners(face);
  Vec3 best = below;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3& from = hull.vertices()[corners[i]];
    const Vec3 along = hull.vertices()[corners[i + 1 < corners.size() ? i + 1 : 0]] - from;
    if (along.cross(face.normal).dot(below - from) <= 0) continue;
    const Vec3 on_edge = from + std::clamp(along.dot(below - from) / along.squaredNorm(), 0.0, 1.0) * along;
    const double distance = (below - on_edge).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    best = on_edge;
  }
  return best;
}

}  // namespace

ClosestOnHull closest_on_hull(const ConvexHull& hull, const Vec3& point) {
  const std::span<const ConvexHull::Face> faces = hull.faces();
  const double tie = 1e-9 * hull.inner_radius();
  ClosestOnHull closest;
  closest.distance = -std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    const double height = faces[i].normal.dot(point) - faces[i].offset;
    if (height > closest.distance + (i == 0 ? 0 : tie)) closest = {point, height, i};
  }
  // Below this the direction from the surface is mere rounding.
  if (closest.distance <= 1e-12 * hull.outer_radius()) {
    closest.point = point - closest.distance * faces[closest.face].normal;
    return closest;
  }
  closest.distance = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    const double height = faces[i].normal.dot(point) - faces[i].offset;
    if (height <= 0 || height >= closest.distance) continue;
    const Vec3 place = closest_on_face(hull, faces[i], point, height);
    const double distance = (point - place).norm();
    if (distance < closest.distance) closest = {place, distance, i};
  }
  return closest;
}

}  // namespace tweenfall::collision
