#pragma once

/// Mass, center of mass and inertia of points, of solids, of meshes and of what is put together from
/// them, with an even density or with one that varies from place to place.
///
/// By default a body has those of its shape, filled evenly. If it is heavier at one end, `weigh` its shape with a
/// density that is a function of position, or combine parts, and give the result to `BodySettings::mass_properties`.

#include <tweenfall/physics/shape.h>

#include <cstddef>
#include <functional>
#include <span>
#include <string>

namespace tweenfall {

/// A mass without size.
struct PointMass {
  double mass = 1;         ///< kg; > 0
  Vec3 position{0, 0, 0};  ///< m
};

/// A ball stretched along its axes. It has only mass; as the shape of a body, take the convex hull of points on it.
struct Ellipsoid {
  Vec3 semi_axes{0.5, 0.5, 0.5};  ///< m; each > 0
};

// Mass given

/// Of a system of points: c = sum m r / sum m, and the inertia about it.
/// @throws std::invalid_argument for no points, or naming the point for a mass not > 0 or a position that is not finite
[[nodiscard]] MassProperties mass_properties(std::span<const PointMass> points);

[[nodiscard]] double volume(const Ellipsoid& ellipsoid) noexcept;  ///< m^3
/// Of an even ellipsoid about its center, its axes along x, y, z.
/// @throws std::invalid_argument for an axis not > 0, or mass not > 0.
[[nodiscard]] MassProperties mass_properties(const Ellipsoid& ellipsoid, double mass);

/// Of parts that move as one, all given in one frame, by the parallel-axis theorem.
/// @throws std::invalid_argument for no parts, and naming the part for one that `validate` refuses.
[[nodiscard]] MassProperties mass_properties(std::span<const MassProperties> parts);

/// What keeps a mesh from having mass properties, in words that name the vertex, the triangle or the edge; empty for a
/// closed mesh with all its triangles wound outwards.
[[nodiscard]] std::string fault_of_solid(const SurfaceMesh& mesh);

/// @throws std::invalid_argument unless mass is > 0, all is finite, and the inertia is possible:
/// symmetric, with no principal moment greater than the sum of the others. Points on a line have a moment of 0;
/// a body must not.
void validate(const MassProperties& properties);

// Density given

/// How dense a solid is: the same everywhere, or a function of position.
class Density {
 public:
  /// @param even  kg/m^3; > 0
  explicit Density(double even);
  /// @param at  kg/m^3, finite and >= 0 at every point of the solid, m, in the frame in which the solid is given
  explicit Density(std::function<double(const Vec3&)> at);

  [[nodiscard]] bool even() const noexcept { return !at_; }
  [[nodiscard]] double at(const Vec3& place) const { return at_ ? at_(place) : even_; }

 private:
  double even_ = 0;
  std::function<double(const Vec3&)> at_;
};

/// How exactly a density is integrated.
struct Quadrature {
  double tolerance = 1e-9;                   ///< error of the mass, relative; 1e-13 to 1
  std::size_t most_evaluations = 2'000'000;  ///< of the density; integration ends there, with the error it then has
};

/// Mass properties by quadrature, and estimates of their errors.
struct WeighedProperties {
  MassProperties properties;
  double mass_error = 0;        ///< kg
  double center_error = 0;      ///< of each coordinate, m
  double inertia_error = 0;     ///< of each element, kg m^2
  std::size_t evaluations = 0;  ///< of the density
};

/// A solid of that density. An even one is in closed form, without error; otherwise the solid is cut into images of
/// cubes, and those into halves across the direction with the greatest error, until the error is within the tolerance.
/// The reported errors are sums of differences between two rules: for a smooth density far above the true ones.
/// Source: the rule of seven points that Kronrod adds to Gauss's of three (Laurie, "Calculation of Gauss-Kronrod
/// quadrature rules", 1997), adapted as in Berntsen, Espelid, Genz, "An adaptive algorithm for the approximate
/// calculation of multiple integrals", 1991.
/// @throws std::invalid_argument for scenery, a density that is negative or not finite, naming the place, and a
/// solid without mass.
[[nodiscard]] WeighedProperties weigh(const Shape& shape, const Density& density, const Quadrature& quadrature = {});
[[nodiscard]] WeighedProperties weigh(const Ellipsoid& ellipsoid, const Density& density,
                                      const Quadrature& quadrature = {});
/// The inside of a closed mesh. It is cut into tetrahedra from its center of mass to its triangles: where these leave
/// the mesh, at hollows in it, the density is evaluated too, and cancels.
[[nodiscard]] WeighedProperties weigh(const SurfaceMesh& mesh, const Density& density,
                                      const Quadrature& quadrature = {});

// Seen from elsewhere

/// The same thing moved and turned; scale is ignored.
[[nodiscard]] MassProperties moved(const MassProperties& properties, const Pose& pose);

/// Scalar moment about the axis through a point, kg m^2.
/// @param axis  any length but 0
[[nodiscard]] double moment_about(const MassProperties& properties, const Vec3& point, const Vec3& axis);

/// The axes about which a thing turns without wobbling.
struct PrincipalAxes {
  Vec3 moments{0, 0, 0};         ///< least first, kg m^2
  Quat orientation{1, 0, 0, 0};  ///< turns x, y, z onto the axes of the first, second and third
};
[[nodiscard]] PrincipalAxes principal_axes(const MassProperties& properties) noexcept;

}  // namespace tweenfall
