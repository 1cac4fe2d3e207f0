#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/closest_on_hull.h"
#include "collision/collide_pairs.h"

namespace tweenfall::collision {

using shapes::Placed;

namespace {

/// The capsule's axis in the hull's space.
struct AxisSegment {
  Vec3 center, direction;
  double half;
  [[nodiscard]] Vec3 at(double t) const { return center + t * direction; }
};

/// A stretch of the axis.
struct Stretch {
  double low, high;

  /// Keeps what lies behind a plane.
  void cut(const AxisSegment& axis, const Vec3& normal, double offset) {
    const double slope = normal.dot(axis.direction), gap = normal.dot(axis.center) - offset;
    if (std::abs(slope) < 1e-12) {
      if (gap > 0) high = low - 1;
    } else if (slope > 0) {
      high = std::min(high, -gap / slope);
    } else {
      low = std::max(low, -gap / slope);
    }
  }
};

/// The nearest places of the axis and of the hull that it does not meet.
struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  double place = 0;  ///< on the axis
  Vec3 on_hull{0, 0, 0};
};

/// Source: Ericson, Real-Time Collision Detection, 2005, section 5.1.9.
Nearest nearest_of_edge(const AxisSegment& axis, const Vec3& from, const Vec3& to) {
  const Vec3 along = to - from, between = axis.center - from;
  const double square = along.squaredNorm(), mixed = axis.direction.dot(along);
  const double along_axis = axis.direction.dot(between), along_edge = along.dot(between);
  const double determinant = square - mixed * mixed;
  double place = 0;
  if (determinant > 1e-12 * square)
    place = std::clamp((mixed * along_edge - along_axis * square) / determinant, -axis.half, axis.half);
  double share = (mixed * place + along_edge) / square;
  if (share < 0 || share > 1) {
    share = std::clamp(share, 0.0, 1.0);
    place = std::clamp(share * mixed - along_axis, -axis.half, axis.half);
  }
  const Vec3 on_edge = from + share * along;
  return {(axis.at(place) - on_edge).norm(), place, on_edge};
}

Nearest nearest_of(const AxisSegment& axis, const ConvexHull& hull) {
  Nearest best;
  for (const double end : {-axis.half, axis.half}) {
    const ClosestOnHull closest = closest_on_hull(hull, axis.at(end));
    if (closest.distance < best.distance) best = {closest.distance, end, closest.point};
  }
  const double tie = 1e-9 * hull.inner_radius();
  for (const ConvexHull::Edge& edge : hull.edges()) {
    const Nearest nearest = nearest_of_edge(axis, hull.vertices()[edge.from], hull.vertices()[edge.to]);
    if (nearest.distance < best.distance - tie) best = nearest;
  }
  return best;
}

/// How an axis gets out of the hull that it meets: the shortest way along faces' normals and across edges.
struct HullExit {
  double separation = -std::numeric_limits<double>::infinity();
  Vec3 normal{0, 0, 0};
  int face = -1;
  int edge = -1;
};

HullExit exit_of(const AxisSegment& axis, const ConvexHull& hull) {
  const double preference = 1e-3 * hull.inner_radius();
  HullExit best;
  for (std::size_t i = 0; i < hull.faces().size(); ++i) {
    const ConvexHull::Face& face = hull.faces()[i];
    const double reach = std::abs(face.normal.dot(axis.direction)) * axis.half;
    const double separation = face.normal.dot(axis.center) - face.offset - reach;
    if (separation > best.separation + (i == 0 ? 0 : 0.1 * preference))
      best = {separation, face.normal, static_cast<int>(i), -1};
  }
  for (std::size_t i = 0; i < hull.edges().size(); ++i) {
    const ConvexHull::Edge& edge = hull.edges()[i];
    const Vec3& left = hull.faces()[edge.left].normal;
    const Vec3& right = hull.faces()[edge.right].normal;
    // Only an edge with a direction across the axis between its two faces' can be the last to let it go.
    if (!(left.dot(axis.direction) * right.dot(axis.direction) < 0)) continue;
    const Vec3& from = hull.vertices()[edge.from];
    const Vec3 along = hull.vertices()[edge.to] - from;
    Vec3 across = axis.direction.cross(along);
    const double length = across.norm();
    if (length < 1e-3 * along.norm()) continue;
    across /= across.dot(left + right) < 0 ? -length : length;
    const double separation = across.dot(axis.center - from);
    if (separation > best.separation + preference) best = {separation, across, -1, static_cast<int>(i)};
  }
  return best;
}

/// The stretch of the axis over a face, between its sides.
Stretch over_face(const AxisSegment& axis, const ConvexHull& hull, const ConvexHull::Face& face) {
  Stretch stretch{-axis.half, axis.half};
  const std::span<const std::uint32_t> corners = hull.corners(face);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3& from = hull.vertices()[corners[i]];
    const Vec3& to = hull.vertices()[corners[i + 1 < corners.size() ? i + 1 : 0]];
    const Vec3 out = (to - from).cross(face.normal).normalized();
    stretch.cut(axis, out, out.dot(from));
  }
  return stretch;
}

/// The face that looks along a direction, all but a small angle; -1 when none does.
int face_along(const ConvexHull& hull, const Vec3& direction) {
  int best = -1;
  double most = 0.999;
  for (std::size_t i = 0; i < hull.faces().size(); ++i) {
    const double along = hull.faces()[i].normal.dot(direction);
    if (along <= most) continue;
    most = along + 1e-9;
    best = static_cast<int>(i);
  }
  return best;
}

/// The stretch of the axis beside the edge that it lies along, if it does.
Stretch beside_edge(const AxisSegment& axis, const ConvexHull& hull, const Nearest& nearest, const Vec3& normal) {
  constexpr double lying_along = 0.05;  // sine of the angle
  const double near = 1e-3 * hull.inner_radius();
  for (const ConvexHull::Edge& edge : hull.edges()) {
    const Vec3& from = hull.vertices()[edge.from];
    const Vec3& to = hull.vertices()[edge.to];
    const double length = (to - from).norm();
    const Vec3 along = (to - from) / length;
    if (along.cross(axis.direction).norm() > lying_along) continue;
    if (std::abs(normal.dot(from - nearest.on_hull)) > near || std::abs(normal.dot(to - nearest.on_hull)) > near)
      continue;
    const double share = along.dot(nearest.on_hull - from);
    if ((from + share * along - nearest.on_hull).norm() > near || share < -near || share > length + near) continue;
    Stretch stretch{-axis.half, axis.half};
    stretch.cut(axis, along, along.dot(to));
    stretch.cut(axis, -along, -along.dot(from));
    return stretch;
  }
  return {0, -1};
}

class HullAndCapsule {
 public:
  HullAndCapsule(const ConvexHull& hull, const AxisSegment& axis, double radius, double margin)
      : hull_(hull), axis_(axis), radius_(radius), margin_(margin) {}

  Manifold collide() {
    Stretch inside{-axis_.half, axis_.half};
    for (const ConvexHull::Face& face : hull_.faces()) inside.cut(axis_, face.normal, face.offset);
    if (inside.low <= inside.high) {
      leave(exit_of(axis_, hull_));
      return manifold_;
    }
    const Nearest nearest = nearest_of(axis_, hull_);
    if (nearest.distance <= 1e-9 * hull_.inner_radius())
      leave(exit_of(axis_, hull_));
    else
      touch(nearest);
    return manifold_;
  }

 private:
  void add(double place, double separation, std::uint32_t feature) {
    const double penetration = radius_ - separation;
    const Vec3 middle = axis_.at(place) - manifold_.normal * (radius_ - 0.5 * penetration);
    add_point(manifold_, middle, penetration, feature, margin_);
  }

  /// Both ends of a stretch carry, above the plane of `normal` through `support`.
  bool lie(const Stretch& stretch, const Vec3& normal, double support) {
    if (!(stretch.high - stretch.low > 1e-3 * radius_)) return false;
    manifold_.normal = normal;
    add(stretch.low, normal.dot(axis_.at(stretch.low)) - support, 1);
    add(stretch.high, normal.dot(axis_.at(stretch.high)) - support, 2);
    return manifold_.count > 0;
  }

  bool lie_on_face(int index) {
    if (index < 0) return false;
    const ConvexHull::Face& face = hull_.faces()[static_cast<std::size_t>(index)];
    return lie(over_face(axis_, hull_, face), face.normal, face.offset);
  }

  void touch(const Nearest& nearest) {
    const Vec3 normal = (axis_.at(nearest.place) - nearest.on_hull) / nearest.distance;
    if (axis_.half > 0) {
      if (lie_on_face(face_along(hull_, normal))) return;
      if (lie(beside_edge(axis_, hull_, nearest, normal), normal, normal.dot(nearest.on_hull))) return;
    }
    manifold_.normal = normal;
    add(nearest.place, nearest.distance, 0);
  }

  void leave(const HullExit& exit) {
    if (exit.face < 0 && exit.edge < 0) return;  // a pose that is no number has no way out
    if (exit.face >= 0 && lie_on_face(exit.face)) return;
    manifold_.normal = exit.normal;
    if (exit.face >= 0) {
      // The deeper end, out through the face.
      const double end = exit.normal.dot(axis_.direction) > 0 ? -axis_.half : axis_.half;
      add(end, exit.separation, 0);
      return;
    }
    const ConvexHull::Edge& edge = hull_.edges()[static_cast<std::size_t>(exit.edge)];
    // Seen along the way out, where the edge and the axis cross.
    const Vec3& from = hull_.vertices()[edge.from];
    const Vec3 side = (hull_.vertices()[edge.to] - from).cross(exit.normal);
    const double place = -side.dot(axis_.center - from) / side.dot(axis_.direction);
    add(std::clamp(place, -axis_.half, axis_.half), exit.separation, 0);
  }

  const ConvexHull& hull_;
  AxisSegment axis_;
  double radius_;
  double margin_;
  Manifold manifold_;
};

}  // namespace

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

Manifold collide(const Hull& a, const Placed& at_a, const Capsule& b, const Placed& at_b, double margin) {
  const Mat3 into = at_a.axes.transpose();
  const AxisSegment axis{into * (at_b.center - at_a.center), into * at_b.axes.col(1), b.half_height};
  return to_world(HullAndCapsule(a.convex, axis, b.radius, margin).collide(), at_a);
}

}  // namespace tweenfall::collision
