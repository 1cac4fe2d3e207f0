#pragma once

// Solids as images of the unit cube, one file per kind of solid: the domain over which a density is integrated.

#include <tweenfall/physics/mass_properties.h>

#include <functional>
#include <vector>

namespace tweenfall::mass {

/// The point of the solid's own space for a point of the cube, and the volume there per volume of the cube.
struct Image {
  Vec3 place;      ///< m
  double stretch;  ///< m^3; negative if a tetrahedron is to be subtracted
};
/// Smooth in all of u, v and w, each from 0 to 1.
using Piece = std::function<Image(double u, double v, double w)>;
using Pieces = std::vector<Piece>;

[[nodiscard]] Pieces pieces_of(const Sphere& sphere);
[[nodiscard]] Pieces pieces_of(const Ellipsoid& ellipsoid);
[[nodiscard]] Pieces pieces_of(const Box& box);
[[nodiscard]] Pieces pieces_of(const Capsule& capsule);
[[nodiscard]] Pieces pieces_of(const Cylinder& cylinder);
[[nodiscard]] Pieces pieces_of(const Cone& cone);
[[nodiscard]] Pieces pieces_of(const TaperedCapsule& capsule);
[[nodiscard]] Pieces pieces_of(const Hull& hull);
/// For a mesh without faults.
[[nodiscard]] Pieces pieces_of(const SurfaceMesh& mesh, const Vec3& apex);

}  // namespace tweenfall::mass
