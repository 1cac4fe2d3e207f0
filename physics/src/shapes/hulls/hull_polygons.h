#pragma once

#include <tweenfall/curves/values.h>

#include <cstdint>
#include <span>
#include <vector>

namespace tweenfall::shapes {

/// The faces of the points' convex hull: each is a list of its corners' indices, counter-clockwise seen from outside,
/// starting from the smallest; the faces are sorted by these lists.
/// @param flat  distance from a plane within which points lie in it, m
/// @throws std::invalid_argument for points that all lie in one plane
[[nodiscard]] std::vector<std::vector<std::uint32_t>> hull_polygons(std::span<const Vec3> points, double flat);

}  // namespace tweenfall::shapes
