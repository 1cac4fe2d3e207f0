#pragma once

#include <tweenfall/curves/values.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tweenfall::shapes {

/// Distance from a plane within which points lie in it: above what single precision leaves of a coordinate, m.
[[nodiscard]] double flat_distance(std::span<const Vec3> points) noexcept;

struct HullTriangle {
  std::array<std::uint32_t, 3> corners;  ///< counter-clockwise seen from outside
  std::array<std::uint32_t, 3> across;   ///< the triangle beyond the edge from each corner to the next
};

/// The convex hull as a closed surface of triangles, by Quickhull with planes as thick as `flat`: a point within that
/// of a plane lies in it, and removes the triangles of that plane when it is added, so that no sliver arises.
/// Source: Barber, Dobkin, Huhdanpaa, The Quickhull algorithm for convex hulls, ACM TOMS 22, 1996.
/// @throws std::invalid_argument for points that all lie in one plane
[[nodiscard]] std::vector<HullTriangle> hull_triangles(std::span<const Vec3> points, double flat);

}  // namespace tweenfall::shapes
