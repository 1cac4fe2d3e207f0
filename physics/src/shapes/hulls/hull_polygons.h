#pragma once

#include <tweenfall/curves/values.h>

#include <cstdint>
#include <span>
#include <vector>

namespace tweenfall::shapes {

/// The faces of the points' convex hull: each the indices of its corners, counter-clockwise seen from outside, from the
/// smallest on; the faces in the order of these lists.
/// @param flat  how near to a plane points lie in it, m
/// @throws std::invalid_argument for points that all lie in one plane
[[nodiscard]] std::vector<std::vector<std::uint32_t>> hull_polygons(std::span<const Vec3> points, double flat);

}  // namespace tweenfall::shapes
