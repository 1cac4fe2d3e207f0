#include "queries/sweep.h"

#include <tweenfall/physics/contact.h>

#include "queries/closest.h"

namespace tweenfall::queries {

namespace {

constexpr int most_advances = 100;
/// Parts of a size: a gap that is none, and one that still tells its direction.
constexpr double met = 1e-13, tells = 1e-9;
/// Of a coordinate.
constexpr double coordinate_rounding = 1e-15;

/// From a shape that is stuck the short way out, where it is known.
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

}  // namespace

std::optional<ShapeHit> first_on_way(const Shape& moving, const Pose& start, const Vec3& displacement,
                                     const Shape& shape, const Pose& pose) {
  const bool endless = std::holds_alternative<Plane>(moving.solid);
  const Bounds box = endless ? bounds(shape, pose) : bounds(moving, start);
  const double size = (box.high - box.low).norm();
  const double none = met * size + coordinate_rounding * (start.position.norm() + pose.position.norm());
  Pose at = start;
  double fraction = 0;
  ShapeHit hit;
  for (int i = 0; i < most_advances; ++i) {
    const Closest closest = closest_between(shape, pose, moving, at);
    if (i == 0 && !(closest.gap > 0)) return stuck(moving, start, displacement, shape, pose, closest.on_a);
    if (i == 0 || closest.core_distance > tells * size) hit.normal = closest.normal;
    hit.fraction = fraction;
    hit.point = closest.on_a;
    const double closing = -displacement.dot(hit.normal);
    if (closest.gap <= none) break;
    if (!(closing > 0)) return std::nullopt;
    fraction += closest.gap / closing;
    if (!(fraction <= 1)) return std::nullopt;
    at.position = start.position + fraction * displacement;
  }
  // What only touches and leaves, or slides along, is not met.
  if (!(displacement.dot(hit.normal) < 0)) return std::nullopt;
  return hit;
}

}  // namespace tweenfall::queries
