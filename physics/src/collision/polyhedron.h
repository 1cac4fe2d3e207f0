#pragma once

/// Convex polyhedra for collision with each other: hulls as they are, boxes as the stretched hull of a cube.

#include <tweenfall/physics/shape.h>

#include <array>
#include <span>

namespace tweenfall::collision {

/// A polyhedron in some space: with vertices and faces of its own, and the topology of its hull.
struct Polyhedron {
  const ConvexHull* hull = nullptr;  ///< how the vertices are joined
  std::span<const Vec3> vertices{};
  std::span<const ConvexHull::Face> faces{};
  double size = 0;             ///< from the middle to the nearest face, m
  const Mat3* axes = nullptr;  ///< only of a box

  [[nodiscard]] std::span<const std::uint32_t> corners(std::size_t face) const { return hull->corners(faces[face]); }

  /// The vertex farthest along a direction: of a box by its axes, else found by climbing from another vertex.
  [[nodiscard]] std::uint32_t farthest(const Vec3& direction, std::uint32_t from) const;
};

/// Memory for the vertices and faces of a polyhedron that is not in its own space.
struct PolyhedronRoom {
  std::array<Vec3, ConvexHull::most_vertices> vertices;
  std::array<ConvexHull::Face, 2 * ConvexHull::most_vertices> faces;
  Mat3 axes;
};

/// The polyhedron turned, then shifted, stored in `room`.
[[nodiscard]] Polyhedron polyhedron(const Hull& hull, const Mat3& turn, const Vec3& shift, PolyhedronRoom& room);
[[nodiscard]] Polyhedron polyhedron(const Box& box, const Mat3& turn, const Vec3& shift, PolyhedronRoom& room);
/// The hull in its own space.
[[nodiscard]] Polyhedron polyhedron(const Hull& hull);

}  // namespace tweenfall::collision
