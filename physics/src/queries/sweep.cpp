#include "queries/sweep.h"

#include <tweenfall/physics/contact.h>

#include "queries/on_surface.h"
#include "shapes/compound.h"

namespace tweenfall::queries {

namespace {

constexpr int most_advances = 100;
/// Relative to a size: a gap that counts as none, and one that still gives its direction.
constexpr double met = 1e-13, tells = 1e-9;
/// How far before the hit to look for the contact point of round cores, which touching cores no longer give; relative
/// to a size.
constexpr double just_before = 1e-8;
/// Relative to a coordinate.
constexpr double coordinate_rounding = 1e-15;

/// For shapes that overlap from the start: the shortest way out, if it is known.
ShapeHit stuck(const Shape& moving, const Pose& start, const Vec3& displacement, const Shape& shape, const Pose& pose,
               const Vec3& common) {
  ShapeHit hit;
  hit.inside = true;
  hit.point = common;
  const Manifold manifold = collide(shape, pose, moving, start);
  if (manifold.count > 0)
    hit.normal = manifold.normal;
  else if (displacement != Vec3::Zero())
    hit.normal = -displacement.normalized();
  return hit;
}

/// The path until two convex shapes meet. `closest_after(gone, first, inside)` says how they are to each other after
/// one has moved by `gone`, with the resting one as a; if they overlap at first, it may fill in `inside`.
template <class ClosestAfter>
std::optional<ShapeHit> advance(const Vec3& displacement, double size, double none, bool round,
                                const ClosestAfter& closest_after) {
  double fraction = 0, core_distance = 0;
  ShapeHit hit, inside;
  for (int i = 0; i < most_advances; ++i) {
    const Closest closest = closest_after(Vec3(fraction * displacement), i == 0, inside);
    if (inside.inside) return inside;
    if (i == 0 || closest.core_distance > tells * size) hit.normal = closest.normal;
    hit.fraction = fraction;
    hit.point = closest.on_a;
    core_distance = closest.core_distance;
    const double closing = -displacement.dot(hit.normal);
    if (closest.gap <= none) break;
    if (!(closing > 0)) return std::nullopt;
    fraction += closest.gap / closing;
    if (!(fraction <= 1)) return std::nullopt;
  }
  // Shapes that only touch and part, or slide along, do not meet.
  const double closing = -displacement.dot(hit.normal);
  if (!(closing > 0)) return std::nullopt;
  if (round && core_distance <= tells * size && fraction > 0) {
    const double before = std::max(0.0, fraction - just_before * size / closing);
    const Closest closest = closest_after(Vec3(before * displacement), false, inside);
    if (closest.core_distance > tells * size) {
      hit.point = closest.on_a;
      hit.normal = closest.normal;
    }
  }
  return hit;
}

/// The first hit among a compound's parts, on its node.
template <class Meet>
std::optional<ShapeHit> first_of_parts(const Compound& compound, const Pose& offset, const Meet& meet) {
  std::optional<ShapeHit> best;
  for (const Shape& part : compound.parts()) {
    const std::optional<ShapeHit> hit = meet(shapes::on_node(part, offset));
    if (hit && (!best || hit->fraction < best->fraction)) best = hit;
  }
  return best;
}

}  // namespace

std::optional<ShapeHit> first_on_way(const Shape& moving, const Pose& start, const Vec3& displacement,
                                     const Shape& shape, const Pose& pose) {
  if (const auto* compound = std::get_if<Compound>(&shape.solid))
    return first_of_parts(*compound, shape.offset,
                          [&](const Shape& part) { return first_on_way(moving, start, displacement, part, pose); });
  if (const auto* compound = std::get_if<Compound>(&moving.solid))
    return first_of_parts(*compound, moving.offset,
                          [&](const Shape& part) { return first_on_way(part, start, displacement, shape, pose); });
  const bool endless = std::holds_alternative<Plane>(moving.solid);
  const auto size_of = [](const Shape& one, const Pose& at) {
    if (std::holds_alternative<Plane>(one.solid) || surfaces::surface_of(one.solid)) return 0.0;
    const Bounds box = bounds(one, at);
    return (box.high - box.low).norm();
  };
  const double size = size_of(shape, pose) + size_of(moving, start);
  const double none = met * size + coordinate_rounding * (start.position.norm() + pose.position.norm());
  const auto is_round = [](const Solid& solid) {
    return std::holds_alternative<Cylinder>(solid) || std::holds_alternative<Cone>(solid) ||
           std::holds_alternative<TaperedCapsule>(solid);
  };
  const bool round = is_round(shape.solid) || is_round(moving.solid);
  const surfaces::Surface* still = surfaces::surface_of(shape.solid);
  const surfaces::Surface* surface = still ? still : surfaces::surface_of(moving.solid);
  if (!surface || endless || std::holds_alternative<Plane>(shape.solid))
    return advance(displacement, size, none, round, [&](const Vec3& gone, bool first, ShapeHit& inside) {
      Pose at = start;
      at.position += gone;
      const Closest closest = closest_between(shape, pose, moving, at);
      if (first && !(closest.gap > 0)) inside = stuck(moving, start, displacement, shape, pose, closest.on_a);
      return closest;
    });
  const Closest first = closest_between(shape, pose, moving, start);
  if (!(first.gap > 0)) return stuck(moving, start, displacement, shape, pose, first.on_a);
  if (!still) {
    // As if it stood still, and the other moved the opposite way.
    std::optional<ShapeHit> hit = first_on_way(shape, pose, -displacement, moving, start);
    if (!hit) return hit;
    hit->normal = -hit->normal;
    hit->point += hit->fraction * displacement;
    return hit;
  }
  std::optional<ShapeHit> best;
  const auto meet_all = [&](const Core& core) {
    visit_on_way(*surface, shapes::place(shape, pose), core, displacement, [&](const Core& triangle) {
      const std::optional<ShapeHit> hit =
          advance(displacement, size, none, round, [&](const Vec3& gone, bool, ShapeHit&) {
            Core at = core;
            at.at.center += gone;
            return closest_between(triangle, at);
          });
      if (hit && (!best || hit->fraction < best->fraction)) best = hit;
      return best ? best->fraction : 1;
    });
  };
  if (const surfaces::Surface* other = surfaces::surface_of(moving.solid))
    other->walk([](const Bounds&) { return true; },
                [&](std::uint32_t index) {
                  const surfaces::SurfaceTriangle triangle = other->triangle(index);
                  meet_all(triangle_core(triangle, shapes::place(moving, start)));
                });
  else
    meet_all(core_of(moving, start));
  return best;
}

}  // namespace tweenfall::queries
