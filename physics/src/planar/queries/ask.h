#pragma once

/// Questions to plates, which those to shapes and to worlds are made of.

#include <tweenfall/physics/planar_query.h>

#include <optional>

#include "planar/queries/difference.h"

namespace tweenfall::planar::inner {

struct Ray {
  Vec2 from{0, 0}, direction{1, 0};  ///< the direction of unit length
  double length = 0;                 ///< m
};

// These throw std::invalid_argument that tells what is wrong.
[[nodiscard]] Ray checked_ray(const Vec2& from, const Vec2& direction, double length);
[[nodiscard]] Plate checked_plate(const Shape& shape, const Place& place);  ///< about the node
void demand_end(const Shape& shape);

[[nodiscard]] Plate point_plate();

[[nodiscard]] std::optional<RayHit> hit_by(const Ray& ray, const Placed& placed);
[[nodiscard]] std::optional<ShapeHit> hit_by(const Placed& moving, const Vec2& displacement, const Placed& placed);
[[nodiscard]] Separation separation_of(const Placed& a, const Placed& b);
[[nodiscard]] Separation separation_of(const Vec2& point, const Placed& b);

}  // namespace tweenfall::planar::inner
