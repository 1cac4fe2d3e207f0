#pragma once

/// Surfaces of triangles, as `sweep` and `lathe` make them, and what they enclose.

#include <tweenfall/curves/values.h>

#include <cstdint>
#include <vector>

namespace tweenfall {

/// Vertices are duplicated where a normal or a texture coordinate jumps; the copies have the same position to the bit.
struct SurfaceMesh {
  std::vector<Vec3> positions;            ///< m
  std::vector<Vec3> normals;              ///< unit, outwards; one per vertex, or empty
  std::vector<Vec2> texture_coordinates;  ///< one per vertex, or empty
  std::vector<std::uint32_t> triangles;   ///< three vertices each, counter-clockwise seen from outside
};

/// The surface with one vertex at each position, in order of first use, and without triangles that have no area left;
/// no normals, no texture coordinates. This is the form that physics takes.
[[nodiscard]] SurfaceMesh welded(const SurfaceMesh& mesh);

/// Whether the surface encloses a volume without a gap: each edge has one triangle on either side, both wound alike.
[[nodiscard]] bool is_closed(const SurfaceMesh& mesh);

/// Measures of the solid that a closed mesh encloses, at uniform density.
struct MeshMeasures {
  double area = 0;              ///< m^2
  double volume = 0;            ///< m^3; negative where the surface is inside out
  Vec3 center{0, 0, 0};         ///< center of mass, m; that of the vertices where there is no volume
  Mat3 inertia = Mat3::Zero();  ///< about the center at a density of 1, m^5
};

/// Exact for the triangles. For an open surface only the area is meaningful.
/// Source: sums over tetrahedra, as in Mirtich, "Fast and accurate computation of polyhedral mass properties", 1996.
[[nodiscard]] MeshMeasures measure(const SurfaceMesh& mesh) noexcept;

}  // namespace tweenfall
