#pragma once

/// Convex hulls: the smallest convex solid around points, as a polyhedron. Physics collides with it in place of a mesh.

#include <tweenfall/curves/surface_mesh.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace tweenfall {

/// An immutable value, cheap to copy. The same points give the same hull, to the bit, on every machine.
///
/// A point nearer to a face than about a millionth of the points' extent, more if the points are noisier than that,
/// counts as lying in it: faces that lie in one plane by this measure are one polygon, and points inside of faces and
/// on straight edges are no vertices.
class ConvexHull {
 public:
  static constexpr std::size_t most_vertices = 256;

  struct Face {
    Vec3 normal;            ///< unit, outwards
    double offset;          ///< the hull lies where normal . x <= offset, m
    std::uint32_t first;    ///< index of its first corner among all faces' corners
    std::uint32_t corners;  ///< how many; >= 3
  };
  struct Edge {
    std::uint32_t from, to;     ///< vertices, from < to
    std::uint32_t left, right;  ///< faces; the left one runs counter-clockwise along from -> to
  };

  /// @throws std::invalid_argument for fewer than four points, one that is not finite,
  ///         points that all lie in one plane,
  ///         or more than `most_vertices` that remain as vertices
  explicit ConvexHull(std::span<const Vec3> points);
  /// The hull of the mesh's vertices.
  explicit ConvexHull(const SurfaceMesh& mesh);
  /// The hull with exactly these vertices and faces, to the bit.
  /// @param faces  corners among the vertices, counter-clockwise seen from outside
  /// @throws std::invalid_argument when they do not form a convex hull
  ConvexHull(std::span<const Vec3> vertices, std::span<const std::vector<std::uint32_t>> faces);
  // Moving copies, so that no hull is ever without its data.
  ConvexHull(const ConvexHull&) noexcept = default;
  ConvexHull& operator=(const ConvexHull&) noexcept = default;

  [[nodiscard]] std::span<const Vec3> vertices() const noexcept;  ///< in the order in which the points were given
  [[nodiscard]] std::span<const Face> faces() const noexcept;
  [[nodiscard]] std::span<const Edge> edges() const noexcept;
  /// The face's vertices, counter-clockwise seen from outside.
  [[nodiscard]] std::span<const std::uint32_t> corners(const Face& face) const noexcept;
  /// The vertices that edges join to this one.
  [[nodiscard]] std::span<const std::uint32_t> neighbors(std::size_t vertex) const noexcept;

  [[nodiscard]] const MeshMeasures& measures() const noexcept;  ///< volume, center of mass, inertia
  [[nodiscard]] double inner_radius() const noexcept;           ///< from the center of mass to the nearest face, m
  [[nodiscard]] double outer_radius() const noexcept;           ///< to the farthest vertex, m

  /// The surface, each face with its own vertices and flat normals.
  [[nodiscard]] SurfaceMesh surface() const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace tweenfall
