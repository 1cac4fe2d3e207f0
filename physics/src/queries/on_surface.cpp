#include "queries/on_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tweenfall::queries {

using shapes::Placed;
using surfaces::Surface;
using surfaces::SurfaceTriangle;

namespace {

/// The box around a core, in a surface's axes.
Bounds box_around(const Core& core, const Placed& at) {
  Bounds box;
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = at.axes.col(i);
    box.high[i] = axis.dot(core.farthest(axis) - at.center) + core.skin;
    box.low[i] = axis.dot(core.farthest(-axis) - at.center) - core.skin;
  }
  return box;
}

double gap_between(const Bounds& a, const Bounds& b) {
  return (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(0.0).norm();
}

void come_nearer(Closest& best, const Surface& surface, const Placed& at, const Core& b) {
  const Bounds box = box_around(b, at);
  const auto near_enough = [&](const Bounds& other) {
    return best.gap > 0 && gap_between(other, box) <= best.gap * (1 + 1e-12);
  };
  surface.walk_near(0.5 * (box.low + box.high), near_enough, [&](std::uint32_t index) {
    const SurfaceTriangle triangle = surface.triangle(index);
    if (!near_enough(triangle.bounds())) return;
    const Closest closest = closest_between(triangle_core(triangle, at), b);
    if (closest.gap < best.gap) best = closest;
  });
}

/// Points as seen along a ray. A vertex looks the same from all triangles that share it, and on which
/// side of an edge the ray passes is computed exactly, so that no ray slips through between two triangles.
/// Source: Woop, Benthin, Wald, Watertight Ray/Triangle Intersection, Journal of Computer Graphics Techniques, 2013.
class SeenAlong {
 public:
  explicit SeenAlong(const Vec3& direction) {
    direction.cwiseAbs().maxCoeff(&along_);
    first_ = (along_ + 1) % 3;
    second_ = (along_ + 2) % 3;
    if (direction[along_] < 0) std::swap(first_, second_);
    shear_ = Vec2(direction[first_], direction[second_]) / direction[along_];
  }

  /// For a triangle, relative to the ray's start, that faces the ray.
  [[nodiscard]] bool holds_origin(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const Vec2 at_a = seen(a), at_b = seen(b), at_c = seen(c);
    return side(at_a, at_b) <= 0 && side(at_b, at_c) <= 0 && side(at_c, at_a) <= 0;
  }

 private:
  [[nodiscard]] Vec2 seen(const Vec3& place) const {
    return Vec2(place[first_], place[second_]) - place[along_] * shear_;
  }
  /// Twice the area that the origin spans with an edge, with the exact sign.
  [[nodiscard]] static double side(const Vec2& from, const Vec2& to) {
    const double ahead = from.x() * to.y(), back = from.y() * to.x();
    const double area = ahead - back;
    if (std::abs(area) > 1e-15 * (std::abs(ahead) + std::abs(back))) return area;
    const double rest_ahead = std::fma(from.x(), to.y(), -ahead), rest_back = std::fma(from.y(), to.x(), -back);
    return area + (rest_ahead - rest_back);
  }

  int along_ = 0, first_ = 1, second_ = 2;
  Vec2 shear_;
};

}  // namespace

Core triangle_core(const SurfaceTriangle& triangle, const Placed& at) {
  Core core;
  core.triangle = &triangle.corners;
  core.at = at;
  return core;
}

Closest closest_on_surface(const Surface& surface, const Placed& at, const Core& b) {
  Closest best;
  best.gap = std::numeric_limits<double>::infinity();
  come_nearer(best, surface, at, b);
  return best;
}

Closest closest_on_surface(const Surface& surface, const Placed& at, const Shape& b, const Pose& pose_b) {
  Closest best;
  best.gap = std::numeric_limits<double>::infinity();
  const auto everywhere = [](const Bounds&) { return true; };
  if (const auto* plane = std::get_if<Plane>(&b.solid)) {
    const Placed at_plane = shapes::place(b, pose_b);
    surface.walk(everywhere, [&](std::uint32_t index) {
      const SurfaceTriangle triangle = surface.triangle(index);
      Closest closest = closest_to_plane(*plane, at_plane, triangle_core(triangle, at));
      if (!(closest.gap < best.gap)) return;
      closest.normal = -closest.normal;
      std::swap(closest.on_a, closest.on_b);
      best = closest;
    });
  } else if (const Surface* other = surfaces::surface_of(b.solid)) {
    const Placed at_other = shapes::place(b, pose_b);
    other->walk(everywhere, [&](std::uint32_t index) {
      const SurfaceTriangle triangle = other->triangle(index);
      if (best.gap > 0) come_nearer(best, surface, at, triangle_core(triangle, at_other));
    });
  } else {
    come_nearer(best, surface, at, core_of(b, pose_b));
  }
  return best;
}

std::optional<RayHit> first_on_surface(const Surface& surface, const Placed& at, const Ray& ray) {
  const Vec3 from = at.axes.transpose() * (ray.from - at.center), direction = at.axes.transpose() * ray.direction;
  const SeenAlong seen(direction);
  double length = ray.length;
  bool met = false;
  Vec3 normal;
  surface.walk_along(
      direction, [&](const Bounds& box) { return meets_box(box, from, direction, length); },
      [&](std::uint32_t index) {
        const SurfaceTriangle triangle = surface.triangle(index);
        const Vec3 a = triangle.corners[0] - from, b = triangle.corners[1] - from, c = triangle.corners[2] - from;
        const Vec3 out = (b - a).cross(c - a);
        const double falling = -direction.dot(out);
        if (!(falling > 0) || !seen.holds_origin(a, b, c)) return;
        // A point just behind the start counts as the start.
        const double distance = -a.dot(out) / falling;
        const double rounding = 1e-14 * (a.norm() + from.norm());
        if (distance < -rounding || !(distance <= length)) return;
        length = std::max(0.0, distance);
        normal = out;
        met = true;
      });
  if (!met) return std::nullopt;
  RayHit hit;
  hit.distance = length;
  hit.point = ray.from + length * ray.direction;
  hit.normal = at.axes * normal.normalized();
  return hit;
}

void visit_on_way(const Surface& surface, const Placed& at, const Core& moving, const Vec3& displacement,
                  const std::function<double(const Core&)>& meet) {
  const Vec3 way = at.axes.transpose() * displacement;
  Bounds box = box_around(moving, at);
  const Vec3 room = Vec3::Constant(1e-12 * (box.low.norm() + box.high.norm()));
  box = {box.low - room, box.high + room};
  double part = 1;
  const auto on_way = [&](const Bounds& other) { return surfaces::meets_on_way(box, part * way, other); };
  surface.walk_along(way, on_way, [&](std::uint32_t index) {
    const SurfaceTriangle triangle = surface.triangle(index);
    const Vec3 out = (triangle.corners[1] - triangle.corners[0]).cross(triangle.corners[2] - triangle.corners[0]);
    if (!(out.dot(way) < 0) || !on_way(triangle.bounds())) return;
    part = std::min(part, meet(triangle_core(triangle, at)) * (1 + 1e-9));
  });
}

}  // namespace tweenfall::queries
