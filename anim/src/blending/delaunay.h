#pragma once

// The triangles of points on a plane that have no point inside their circumcircles.

#include <tweenfall/curves/values.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace tweenfall::blending {

using Triangle = std::array<std::size_t, 3>;

/// Twice the area of a triangle, above 0 where it is counter-clockwise: up to its sign the same number for any order of
/// the corners, so that neighbors agree on which side of their edge a point is.
[[nodiscard]] double turn_of(std::span<const Vec2> points, std::size_t a, std::size_t b, const Vec2& p) noexcept;

struct Triangulation {
  std::vector<Triangle> triangles;  ///< counter-clockwise
  std::vector<std::size_t> border;  ///< counter-clockwise
};

/// The triangulation of distinct points within a square of size 1. No triangles where all lie on one line, to 1e-12.
[[nodiscard]] Triangulation delaunay(std::span<const Vec2> points);

}  // namespace tweenfall::blending
