#include "queries/rays.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <stdexcept>

#include "queries/checked.h"
#include "queries/on_surface.h"
#include "queries/turned_rays.h"
#include "shapes/compound.h"
#include "shapes/placed.h"

namespace tweenfall::queries {

namespace {

using MaybeEntry = std::optional<Entry>;

const Entry from_inside = {0, {0, 1, 0}, true};

/// Both distances at which a ray is at this distance from the origin; empty if it passes by, or lies inside together
/// with `from`. Computed relative to where the ray comes nearest, so that a far start loses nothing. Source: Haines and
/// others, Precision Improvements for Ray/Sphere Intersection, Ray Tracing Gems, 2019.
template <class Vector>
std::optional<double> enters_round(const Vector& from, const Vector& direction, double radius) {
  const double square = direction.squaredNorm();
  if (!(square > 0)) return std::nullopt;
  const double nearest = -from.dot(direction) / square;
  const Vector across = from + nearest * direction;
  const double room = radius * radius - across.squaredNorm();
  if (!(room >= 0) || !(nearest > 0)) return std::nullopt;
  return nearest - std::sqrt(room / square);
}

MaybeEntry enters(const Sphere& sphere, const Vec3& from, const Vec3& direction) {
  if (from.norm() <= sphere.radius) return from_inside;
  const std::optional<double> distance = enters_round(from, direction, sphere.radius);
  if (!distance) return std::nullopt;
  return Entry{*distance, (from + *distance * direction).normalized()};
}

MaybeEntry enters(const Plane& plane, const Vec3& from, const Vec3& direction) {
  const double height = plane.normal.dot(from) - plane.offset;
  if (height <= 0) return from_inside;
  const double falling = -plane.normal.dot(direction);
  if (!(falling > 0)) return std::nullopt;
  return Entry{height / falling, plane.normal};
}

/// The part of a ray on the inner side of all half spaces given so far.
struct Clipped {
  double enter = 0, leave = std::numeric_limits<double>::infinity();
  Vec3 normal{0, 1, 0};
  bool inside = true, misses = false;

  /// Keeps the part behind normal . x <= offset, which the ray's start exceeds by `height`.
  void clip(double height, double rising, const Vec3& outward) {
    if (height > 0) {
      inside = false;
      if (!(rising < 0)) {
        misses = true;
        return;
      }
      const double at = -height / rising;
      if (at < enter) return;
      enter = at;
      normal = outward;
    } else if (rising > 0) {
      leave = std::min(leave, -height / rising);
    }
  }
  [[nodiscard]] MaybeEntry entry() const {
    if (misses || enter > leave) return std::nullopt;
    return inside ? from_inside : Entry{enter, normal};
  }
};

MaybeEntry enters(const Box& box, const Vec3& from, const Vec3& direction) {
  Clipped clipped;
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = Vec3::Unit(i);
    clipped.clip(from[i] - box.half_extents[i], direction[i], axis);
    clipped.clip(-from[i] - box.half_extents[i], -direction[i], -axis);
  }
  return clipped.entry();
}

MaybeEntry enters(const Hull& hull, const Vec3& from, const Vec3& direction) {
  Clipped clipped;
  for (const ConvexHull::Face& face : hull.convex.faces())
    clipped.clip(face.normal.dot(from) - face.offset, face.normal.dot(direction), face.normal);
  return clipped.entry();
}

MaybeEntry enters(const Capsule& capsule, const Vec3& from, const Vec3& direction) {
  const auto on_axis = [&capsule](const Vec3& point) {
    return Vec3(0, std::clamp(point.y(), -capsule.half_height, capsule.half_height), 0);
  };
  if ((from - on_axis(from)).norm() <= capsule.radius) return from_inside;
  MaybeEntry first;
  const auto take = [&](const std::optional<double>& distance, bool ball, double end) {
    // Points between the prolonged sides but beyond an end lie behind that end's hit.
    if (!distance || *distance < 0 || (first && first->distance <= *distance)) return;
    const Vec3 point = from + *distance * direction;
    if (ball ? point.y() * end < capsule.half_height : std::abs(point.y()) > capsule.half_height) return;
    const Vec3 out = point - on_axis(point);
    first = Entry{*distance, out.normalized()};
  };
  using Vec2 = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;
  take(enters_round(Vec2(from.x(), from.z()), Vec2(direction.x(), direction.z()), capsule.radius), false, 0);
  for (const double end : {-1.0, 1.0})
    take(enters_round(Vec3(from - Vec3(0, end * capsule.half_height, 0)), direction, capsule.radius), true, end);
  return first;
}

template <class T>
concept IsMany = std::same_as<T, Compound> || std::same_as<T, TriangleMesh> || std::same_as<T, HeightField>;

/// Never called: their parts or triangles are asked instead.
template <IsMany Many>
MaybeEntry enters(const Many&, const Vec3&, const Vec3&) {
  return std::nullopt;
}

}  // namespace

Ray checked_ray(const Vec3& from, const Vec3& direction, double length) {
  require_finite(from, "the start of a ray");
  require_finite(direction, "the direction of a ray");
  require_amount(length, "the length of a ray");
  if (direction == Vec3::Zero()) throw std::invalid_argument("the direction of a ray must not be zero");
  // Scaled first: squares of very long or short directions overflow or vanish.
  Vec3 unit = direction / direction.cwiseAbs().maxCoeff();
  unit /= unit.norm();
  return {from, unit, length};
}

std::optional<RayHit> first_on_ray(const Shape& shape, const Pose& pose, const Ray& ray) {
  if (const auto* compound = std::get_if<Compound>(&shape.solid)) {
    std::optional<RayHit> first;
    for (const Shape& part : compound->parts()) {
      const std::optional<RayHit> hit = first_on_ray(shapes::on_node(part, shape.offset), pose, ray);
      if (hit && (!first || hit->distance < first->distance)) first = hit;
    }
    return first;
  }
  if (const surfaces::Surface* surface = surfaces::surface_of(shape.solid))
    return first_on_surface(*surface, shapes::place(shape, pose), ray);
  const shapes::Placed at = shapes::place(shape, pose);
  const Vec3 from = at.axes.transpose() * (ray.from - at.center);
  const Vec3 direction = at.axes.transpose() * ray.direction;
  const MaybeEntry entry = std::visit([&](const auto& solid) { return enters(solid, from, direction); }, shape.solid);
  if (!entry || !(entry->distance <= ray.length)) return std::nullopt;
  RayHit hit;
  hit.distance = entry->distance;
  hit.inside = entry->inside;
  hit.point = ray.from + entry->distance * ray.direction;
  hit.normal = entry->inside ? Vec3(-ray.direction) : Vec3(at.axes * entry->normal);
  return hit;
}

}  // namespace tweenfall::queries
