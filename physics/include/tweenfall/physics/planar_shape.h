#pragma once

/// Shapes in a plane, and what follows from them: area, mass, center of mass, moment of inertia, and where two touch.

#include <tweenfall/curves/values.h>

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

namespace tweenfall::planar {

struct Circle {
  double radius = 0.5;  ///< m; > 0
};
/// A rectangle with half circles on its ends, along the local y axis.
struct Capsule {
  double radius = 0.25;      ///< m; > 0
  double half_height = 0.5;  ///< half the length of the straight part, m; >= 0
};
struct Box {
  Vec2 half_extents{0.5, 0.5};  ///< m; each > 0
};
/// A convex polygon; its center of mass need not be its origin.
struct Polygon {
  static constexpr std::size_t most_corners = 64;
  std::vector<Vec2> corners;  ///< in order around the outline, either way, m; 3 to 64, each turning the same way
};
/// Everything behind an infinite line; only for bodies that never move by themselves.
struct HalfPlane {
  Vec2 normal{0, 1};  ///< out of the solid; any length but 0
  double offset = 0;  ///< points x of the line have normal . x = offset for the unit normal, m
};

/// An outline in a compound, and its place there.
struct Part {
  std::variant<Circle, Capsule, Box, Polygon> outline = Circle{};
  Vec2 offset{0, 0};  ///< of the outline, m
  double angle = 0;   ///< rad
};
/// Several outlines that move as one, each with its own contacts. Where parts overlap, their mass counts twice.
struct Compound {
  static constexpr std::size_t most_parts = 4096;
  std::vector<Part> parts;  ///< 1 to 4096
};

using Outline = std::variant<Circle, Capsule, Box, Polygon, HalfPlane, Compound>;

/// An outline and its place on the node that carries it.
struct Shape {
  Outline outline = Circle{};
  Vec2 offset{0, 0};  ///< of the outline from the node, m
  double angle = 0;   ///< of the outline relative to the node, rad
};

/// Where a body is: its node's origin and its rotation, counterclockwise.
struct Place {
  Vec2 position{0, 0};  ///< m
  double angle = 0;     ///< rad, any number of turns
};

/// @throws std::invalid_argument naming the size that is not positive or not finite, or the corner that turns the wrong
/// way, and for a compound the index of the part.
void validate(const Shape& shape);

[[nodiscard]] double area(const Outline& outline);  ///< m^2; infinity for a half-plane

struct MassProperties {
  double mass = 0;    ///< kg
  Vec2 center{0, 0};  ///< center of mass relative to the node, m
  double moment = 0;  ///< of inertia about the center of mass, kg m^2
};

/// Of a uniform plate. Sources: closed forms, e.g. Goldstein, Classical Mechanics; for polygons Green's theorem over
/// the corners; for compounds the parallel-axis theorem.
/// @throws std::invalid_argument for a half-plane, or mass not > 0.
[[nodiscard]] MassProperties mass_properties(const Shape& shape, double mass);

struct ContactPoint {
  Vec2 position{0, 0};        ///< midway between the two surfaces, world, m
  double penetration = 0;     ///< m; negative for a gap
  std::uint32_t feature = 0;  ///< which features touch; the same contact keeps its number from step to step
};

/// Where two shapes touch: up to two points with one normal.
struct Manifold {
  Vec2 normal{0, 1};  ///< unit, world, out of the first shape toward the second
  std::array<ContactPoint, 2> points{};
  int count = 0;  ///< 0 when the shapes are farther apart than the margin
};

/// Contact of two placed shapes; for compounds, of the two parts that overlap most deeply or are nearest.
/// @param margin  points with a gap up to this are reported too, m; >= 0
[[nodiscard]] Manifold collide(const Shape& a, const Place& place_a, const Shape& b, const Place& place_b,
                               double margin = 0);

}  // namespace tweenfall::planar
