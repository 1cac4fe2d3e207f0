#pragma once

/// Queries on plates, on which those on shapes and worlds are built.

#include <tweenfall/physics/planar_query.h>

#include <optional>
#include <vector>

#include "planar/queries/difference.h"

namespace tweenfall::planar::inner {

struct Ray {
  Vec2 from{0, 0}, direction{1, 0};  ///< the direction of unit length
  double length = 0;                 ///< m
};

// These throw std::invalid_argument saying what is wrong.
[[nodiscard]] Ray checked_ray(const Vec2& from, const Vec2& direction, double length);
[[nodiscard]] std::vector<Plate> checked_plates(const Shape& shape, const Place& place);  ///< about the node
void demand_end(const Shape& shape);

/// All plates of a shape, at its place.
struct Figure {
  const std::vector<Plate>& plates;
  Vec2 center{0, 0};
  Turn turn;

  [[nodiscard]] Placed placed(const Plate& plate) const { return {&plate, center, turn}; }
  [[nodiscard]] bool endless() const { return plates[0].endless; }
};

[[nodiscard]] std::optional<RayHit> hit_by(const Ray& ray, const Figure& figure);
[[nodiscard]] std::optional<ShapeHit> hit_by(const Figure& moving, const Vec2& displacement, const Figure& figure);
[[nodiscard]] Separation separation_of(const Figure& a, const Figure& b);
[[nodiscard]] Separation separation_of(const Vec2& point, const Figure& b);

}  // namespace tweenfall::planar::inner
