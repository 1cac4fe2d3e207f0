#pragma once

/// A shape for contacts: a point, a side or a convex polygon, with a round skin.

#include <tweenfall/physics/planar_shape.h>

#include <vector>

namespace tweenfall::planar::inner {

/// Not initialized, since hundreds of them are made for every pair.
struct Corner {
  Vec2 at;      ///< from the center of mass, node axes, m
  Vec2 normal;  ///< unit, out of the side that leads from here to the next corner; unused for a lone corner
};

struct Plate {
  std::vector<Corner> corners;  ///< counterclockwise; one for a circle, two for a capsule; for a half-plane its line
  double skin = 0;              ///< m
  double reach = 0;             ///< farthest point from the center of mass, m
  Vec2 middle{0, 0};            ///< its own center, from the center of mass, m
  double size = 0;              ///< farthest point from there, m
  double least = 0;             ///< about how thin it is, m
  bool endless = false;         ///< a half-plane
};

/// One per part. @param center  of mass, on the node
[[nodiscard]] std::vector<Plate> plates_of(const Shape& shape, const Vec2& center);

}  // namespace tweenfall::planar::inner
