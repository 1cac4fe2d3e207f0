#include "queries/closest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "collision/convex/simplex.h"
#include "queries/on_surface.h"
#include "shapes/compound.h"

namespace tweenfall::queries {

namespace {

using convex::Simplex;

constexpr int most_corners = 200;
/// By how much the distance may still be too long, relative to itself and to the cores' size.
constexpr double close_enough = 1e-14, distance_rounding = 1e-15;

Closest swapped(Closest closest) {
  closest.normal = -closest.normal;
  std::swap(closest.on_a, closest.on_b);
  return closest;
}

/// Adds the skins.
Closest with_skins(Closest closest, double distance, double skin_a, double skin_b) {
  closest.gap = distance - (skin_a + skin_b);
  if (closest.gap > 0) {
    closest.on_a += skin_a * closest.normal;
    closest.on_b -= skin_b * closest.normal;
  } else {
    // The middle of the segment between the cores that both skins cover.
    const double from = std::max(0.0, distance - skin_b), to = std::min(distance, skin_a);
    closest.on_a = closest.on_b = closest.on_a + 0.5 * (from + to) * closest.normal;
  }
  return closest;
}

/// The closest of the results of `ask` for each part on its node.
template <class Ask>
Closest closest_of_parts(const Compound& compound, const Pose& offset, const Ask& ask) {
  Closest best;
  best.gap = std::numeric_limits<double>::infinity();
  for (const Shape& part : compound.parts()) {
    const Closest closest = ask(shapes::on_node(part, offset));
    if (closest.gap < best.gap) best = closest;
  }
  return best;
}

}  // namespace

/// Source: Gilbert, Johnson, Keerthi, A Fast Procedure for Computing the Distance Between Complex Objects in
/// Three-Dimensional Space, 1988; van den Bergen, A Fast and Robust GJK Implementation for Collision Detection of
/// Convex Objects, 1999.
Closest closest_between(const Core& a, const Core& b) {
  // Relative to a's center, so that nothing is lost far from the origin of the world.
  const Vec3 origin = a.at.center;
  Core near = a, other = b;
  near.at.center = Vec3::Zero();
  other.at.center = b.at.center - origin;
  const auto corner_along = [&](const Vec3& direction) {
    Simplex::Corner corner;
    corner.on_a = near.farthest(direction);
    corner.on_b = other.farthest(-direction);
    corner.difference = corner.on_a - corner.on_b;
    return corner;
  };
  Vec3 between = -other.at.center;
  if (between == Vec3::Zero()) between = Vec3(1, 0, 0);
  Simplex simplex;
  simplex.add(corner_along(-between));
  between = simplex.reduce();
  double size = between.norm();
  bool meet = false;
  for (int i = 0; i < most_corners; ++i) {
    const double square = between.squaredNorm();
    meet = square <= distance_rounding * distance_rounding * size * size;
    if (meet) break;
    const Simplex::Corner corner = corner_along(-between);
    size = std::max(size, corner.difference.norm());
    // No point is farther toward zero than this corner: this bounds what is left to gain.
    if (square - between.dot(corner.difference) <= close_enough * square + distance_rounding * size * std::sqrt(square))
      break;
    if (simplex.has(corner.difference)) break;
    Simplex next = simplex;
    next.add(corner);
    const Vec3 nearer = next.reduce();
    if (next.count == 4) {
      simplex = next;
      meet = true;
      break;
    }
    if (!(nearer.squaredNorm() < square)) break;
    simplex = next;
    between = nearer;
  }
  Closest closest;
  closest.on_a = origin + simplex.on_a();
  closest.on_b = origin + simplex.on_b();
  const double distance = closest.core_distance = meet ? 0 : between.norm();
  if (!meet) closest.normal = -between / distance;
  if (meet) closest.on_a = closest.on_b = 0.5 * (closest.on_a + closest.on_b);
  return with_skins(closest, distance, a.skin, b.skin);
}

Closest closest_to_plane(const Plane& plane, const shapes::Placed& at, const Core& b) {
  Closest closest;
  closest.normal = at.axes * plane.normal;
  const Vec3 lowest = b.farthest(-closest.normal) - b.skin * closest.normal;
  closest.gap = closest.normal.dot(lowest - at.center) - plane.offset;
  closest.core_distance = std::numeric_limits<double>::infinity();
  closest.on_a = closest.gap > 0 ? Vec3(lowest - closest.gap * closest.normal) : lowest;
  closest.on_b = lowest;
  return closest;
}

Closest closest_between(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b) {
  if (const auto* compound = std::get_if<Compound>(&a.solid))
    return closest_of_parts(*compound, a.offset,
                            [&](const Shape& part) { return closest_between(part, pose_a, b, pose_b); });
  if (const auto* compound = std::get_if<Compound>(&b.solid))
    return closest_of_parts(*compound, b.offset,
                            [&](const Shape& part) { return closest_between(a, pose_a, part, pose_b); });
  if (const surfaces::Surface* surface = surfaces::surface_of(a.solid))
    return closest_on_surface(*surface, shapes::place(a, pose_a), b, pose_b);
  if (const surfaces::Surface* surface = surfaces::surface_of(b.solid))
    return swapped(closest_on_surface(*surface, shapes::place(b, pose_b), a, pose_a));
  if (const auto* plane = std::get_if<Plane>(&a.solid))
    return closest_to_plane(*plane, shapes::place(a, pose_a), core_of(b, pose_b));
  if (const auto* plane = std::get_if<Plane>(&b.solid))
    return swapped(closest_to_plane(*plane, shapes::place(b, pose_b), core_of(a, pose_a)));
  return closest_between(core_of(a, pose_a), core_of(b, pose_b));
}

Closest nearest_to(const Shape& shape, const Pose& pose, const Vec3& point) {
  if (const auto* compound = std::get_if<Compound>(&shape.solid))
    return closest_of_parts(*compound, shape.offset, [&](const Shape& part) { return nearest_to(part, pose, point); });
  static const Solid dot = Sphere{0};
  const Core core{&dot, {point, Mat3::Identity()}, 0};
  Closest closest;
  if (const auto* plane = std::get_if<Plane>(&shape.solid))
    closest = swapped(closest_to_plane(*plane, shapes::place(shape, pose), core));
  else if (const surfaces::Surface* surface = surfaces::surface_of(shape.solid))
    closest = swapped(closest_on_surface(*surface, shapes::place(shape, pose), core));
  else
    closest = closest_between(core, core_of(shape, pose));
  // Inside, the point itself, and not one that rounding has moved.
  if (!(closest.gap > 0)) closest.on_a = closest.on_b = point;
  return closest;
}

}  // namespace tweenfall::queries
