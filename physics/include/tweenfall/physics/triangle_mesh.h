#pragma once

/// Triangle meshes as scenery: bodies on a mesh touch its triangles, not a hull around them.

#include <tweenfall/curves/surface_mesh.h>

#include <cstdint>
#include <memory>
#include <span>

namespace tweenfall {

namespace surfaces {
class Surface;
class MeshSurface;
}  // namespace surfaces

/// An immutable value, cheap to copy, with a tree over its triangles; only for bodies that never move by themselves.
///
/// It is a surface, not a solid: what comes from the front of a triangle, where its corners run counter-clockwise, is
/// stopped; what comes from behind passes. A solid is in front of a triangle while its center is. Edges between
/// triangles that lie in one plane, or that meet in a hollow, are not felt. Vertices at the same place, to the bit, are
/// one. Triangles without area, flatter than a billionth of their length, are left out.
class TriangleMesh {
 public:
  static constexpr std::size_t most_triangles = 20'000'000;

  /// @throws std::invalid_argument for a vertex that is not finite or beyond 1e30 m, a triangle that names
  ///         a vertex that does not exist,
  ///         a mesh without any triangle that has area, or more than `most_triangles`
  explicit TriangleMesh(const SurfaceMesh& mesh);
  // Moving copies, so that no mesh is ever without its data.
  TriangleMesh(const TriangleMesh&) noexcept = default;
  TriangleMesh& operator=(const TriangleMesh&) noexcept = default;

  [[nodiscard]] std::span<const Vec3> vertices() const noexcept;
  [[nodiscard]] std::span<const std::uint32_t> triangles() const noexcept;  ///< three vertices each
  [[nodiscard]] SurfaceMesh surface() const;                                ///< without normals

  [[nodiscard]] const surfaces::Surface& inside() const noexcept;  ///< for internal use by the physics

 private:
  std::shared_ptr<const surfaces::MeshSurface> surface_;
};

}  // namespace tweenfall
