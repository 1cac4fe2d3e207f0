#pragma once

// Polygons cut into triangles.

#include <tweenfall/curves/values.h>

#include <array>
#include <span>
#include <vector>

namespace tweenfall::fbx {

/// Corners of the triangles, as indices into the polygon. A convex or very large polygon is cut from its first corner,
/// another one ear by ear, in the plane that fits it best.
/// Source: G. Meisters, "Polygons have ears", 1975; the plane after M. Newell.
[[nodiscard]] std::vector<std::array<std::size_t, 3>> triangles_of(std::span<const Vec3> polygon);

}  // namespace tweenfall::fbx
