#pragma once

/// Shapes of bodies, and what follows from them: volume, mass, center of mass, inertia.

#include <tweenfall/curves/pose.h>
#include <tweenfall/curves/surface_mesh.h>
#include <tweenfall/physics/convex_hull.h>
#include <tweenfall/physics/height_field.h>
#include <tweenfall/physics/triangle_mesh.h>

#include <memory>
#include <span>
#include <variant>
#include <vector>

namespace tweenfall {

struct Sphere {
  double radius = 0.5;  ///< m; > 0
};
struct Box {
  Vec3 half_extents{0.5, 0.5, 0.5};  ///< m; each > 0
};
/// A cylinder with half balls on its ends, along the local y axis.
struct Capsule {
  double radius = 0.25;      ///< m; > 0
  double half_height = 0.5;  ///< half the length of the cylinder part, m; >= 0
};
/// A round rod with flat ends, along the local y axis.
struct Cylinder {
  double radius = 0.5;       ///< m; > 0
  double half_height = 0.5;  ///< half the distance between its ends, m; > 0
};
/// A cone along the local y axis, its tip up; the origin is midway between tip and base.
struct Cone {
  double radius = 0.5;       ///< of the base, m; > 0
  double half_height = 0.5;  ///< half the distance from base to tip, m; at least a thousandth of the radius
};
/// The convex hull of two balls on the local y axis.
struct TaperedCapsule {
  double bottom_radius = 0.25;  ///< of the ball at -y, m; > 0
  double top_radius = 0.15;     ///< of the ball at +y, m; > 0
  double half_height = 0.5;     ///< half the distance between their centers, m; neither ball contains the other
};
/// Everything behind an infinite plane; only for bodies that never move by themselves.
struct Plane {
  Vec3 normal{0, 1, 0};  ///< unit, out of the solid
  double offset = 0;     ///< points x of the surface have normal . x = offset, m
};

/// A convex polyhedron; its center of mass need not be its origin.
struct Hull {
  ConvexHull convex;
};

struct Shape;

/// Several solids that move as one, each with its own contacts. An immutable value, cheap to copy. Where parts overlap,
/// their mass counts twice.
class Compound {
 public:
  static constexpr std::size_t most_parts = 4096;

  /// @param parts  solids and their poses in the compound's space
  /// @throws std::invalid_argument for no parts or too many, for planes, meshes, fields and compounds among them, and
  /// for impossible sizes
  explicit Compound(std::vector<Shape> parts);
  // Moving copies, so that no compound is ever without its parts.
  Compound(const Compound&) noexcept = default;
  Compound& operator=(const Compound&) noexcept = default;

  [[nodiscard]] std::span<const Shape> parts() const noexcept;

 private:
  std::shared_ptr<const std::vector<Shape>> parts_;
};

using Solid = std::variant<Sphere, Box, Capsule, Plane, Hull, Cylinder, Cone, TaperedCapsule, Compound, TriangleMesh,
                           HeightField>;

/// Whether a solid has no end or no volume, and so no mass: a plane, a triangle mesh or a height field. Only bodies
/// that never move by themselves can have such a shape.
[[nodiscard]] bool is_scenery(const Solid& solid) noexcept;
/// In words: "a plane", "a box", ...
[[nodiscard]] const char* kind_name(const Solid& solid) noexcept;

/// A solid and its pose on the node that carries it.
struct Shape {
  Solid solid = Sphere{};
  Pose offset = {};  ///< of the solid, relative to the node; scale is ignored
};

struct MassProperties {
  double mass = 0;              ///< kg
  Vec3 center{0, 0, 0};         ///< center of mass relative to the node, m
  Mat3 inertia = Mat3::Zero();  ///< about the center of mass, node axes, kg m^2
};

/// @throws std::invalid_argument naming the size that is not positive or not finite.
void validate(const Solid& solid);

[[nodiscard]] double volume(const Solid& solid) noexcept;  ///< m^3; infinity for scenery

/// Mass properties of a uniform solid of the given mass. Sources: closed forms, e.g. Goldstein, Classical Mechanics.
/// @throws std::invalid_argument for scenery, for sizes that `validate` refuses, or mass not > 0.
[[nodiscard]] MassProperties mass_properties(const Shape& shape, double mass);

/// Mass properties of the volume inside a closed mesh, filled evenly, in the mesh's own space.
/// @throws std::invalid_argument for a mesh that is open or inside out, naming the edge or triangle, or mass not > 0.
[[nodiscard]] MassProperties mass_properties(const SurfaceMesh& mesh, double mass);

/// The inertia about `point` (node frame) instead, by the parallel-axis theorem.
[[nodiscard]] Mat3 inertia_about(const MassProperties& properties, const Vec3& point) noexcept;

/// Axis-aligned box around a placed shape.
struct Bounds {
  Vec3 low, high;
};
[[nodiscard]] Bounds bounds(const Shape& shape, const Pose& node) noexcept;

}  // namespace tweenfall
