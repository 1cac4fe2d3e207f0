#pragma once

/// Questions about where shapes and bodies are: rays, moving shapes, overlaps, distances.
///
/// Nothing here changes a world, and anything added, moved or removed since its last step counts at once: bodies are
/// where `World::motion` says. Several threads may query the same world at a time.
/// A solid is closed: its surface belongs to it. A plane is the half space behind it. A triangle mesh or height field
/// is a surface: rays and moving shapes hit its front only,
/// distances and overlaps are those of the surface, from either side.
/// A surface normal points out of the solid that was hit.

#include <tweenfall/physics/world.h>

#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace tweenfall {

// Two shapes, each placed by the pose of its node

struct RayHit {
  double distance = 0;   ///< along the ray, m
  Vec3 point{0, 0, 0};   ///< world
  Vec3 normal{0, 1, 0};  ///< unit, out of the solid; against the ray where the ray starts inside
  bool inside = false;   ///< the ray starts in the solid: it is hit at once, at its start
};

/// Where a ray first meets a shape.
/// @param direction  of any length but 0
/// @param length     m; may be infinite
/// @throws std::invalid_argument for a direction of length 0, a negative length, or numbers that are not finite
[[nodiscard]] std::optional<RayHit> cast_ray(const Shape& shape, const Pose& pose, const Vec3& from,
                                             const Vec3& direction,
                                             double length = std::numeric_limits<double>::infinity());

struct ShapeHit {
  double fraction = 0;   ///< the free part of the displacement, 0 to 1
  Vec3 point{0, 0, 0};   ///< where the two touch then, world
  Vec3 normal{0, 1, 0};  ///< unit, out of the shape that was hit
  bool inside = false;   ///< the two overlap from the start; the normal is then the shortest way out
};

/// How far `moving` gets, without turning, until it hits `shape`: to a billionth of their size.
/// Source: conservative advancement, Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems, 1996, chapter 2.
/// @throws std::invalid_argument for numbers that are not finite, or two planes
[[nodiscard]] std::optional<ShapeHit> cast_shape(const Shape& moving, const Pose& start, const Vec3& displacement,
                                                 const Shape& shape, const Pose& pose);

struct Separation {
  double distance = 0;  ///< m; 0 where they touch or overlap
  Vec3 on_a{0, 0, 0};   ///< the nearest points, world; for overlapping shapes, one common point
  Vec3 on_b{0, 0, 0};
};

/// The gap between two shapes.
/// Source: Gilbert, Johnson, Keerthi, A Fast Procedure for Computing the Distance Between Complex Objects in
/// Three-Dimensional Space, 1988.
/// @throws std::invalid_argument for numbers that are not finite, or two planes
[[nodiscard]] Separation distance(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b);
[[nodiscard]] bool overlapping(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b);

/// The point of a solid that is nearest to `point`: `point` itself where it is inside.
[[nodiscard]] Vec3 closest_point(const Shape& shape, const Pose& pose, const Vec3& point);

// All bodies of a world

/// Which bodies, or nodes, a query considers.
template <class Who>
struct Asked {
  std::uint64_t groups = ~std::uint64_t{0};  ///< only bodies that belong to one of these
  bool sensors = false;                      ///< whether sensors are included
  std::function<bool(Who)> accept{};         ///< only those for which it returns true; absent: all
};
using QueryFilter = Asked<BodyId>;

struct BodyRayHit : RayHit {
  BodyId body;
};
struct BodyShapeHit : ShapeHit {
  BodyId body;
};
struct NearestBody {
  BodyId body;
  double distance = 0;  ///< m; 0 inside
  Vec3 point{0, 0, 0};  ///< of the body, world
};

/// The first body that a ray hits; of several at the same distance, the one with the smallest index.
/// @throws std::invalid_argument as for one shape; likewise for all functions below
[[nodiscard]] std::optional<BodyRayHit> cast_ray(const World& world, const Vec3& from, const Vec3& direction,
                                                 double length = std::numeric_limits<double>::infinity(),
                                                 const QueryFilter& filter = {});
/// All bodies on the ray, each where the ray first hits it, by distance and then by index.
[[nodiscard]] std::vector<BodyRayHit> cast_ray_through(const World& world, const Vec3& from, const Vec3& direction,
                                                       double length = std::numeric_limits<double>::infinity(),
                                                       const QueryFilter& filter = {});
/// The first body that the shape hits on its way; the shape may not be a plane.
[[nodiscard]] std::optional<BodyShapeHit> cast_shape(const World& world, const Shape& shape, const Pose& start,
                                                     const Vec3& displacement, const QueryFilter& filter = {});
/// The bodies that touch or overlap the shape, by index; the shape may not be a plane.
[[nodiscard]] std::vector<BodyId> overlapping(const World& world, const Shape& shape, const Pose& pose,
                                              const QueryFilter& filter = {});
/// The body nearest to a point, if one is no farther away than `within`.
[[nodiscard]] std::optional<NearestBody> nearest_body(const World& world, const Vec3& point,
                                                      double within = std::numeric_limits<double>::infinity(),
                                                      const QueryFilter& filter = {});
/// The point of one body that is nearest to `point`. @throws std::invalid_argument for a stale handle too
[[nodiscard]] Vec3 closest_point(const World& world, BodyId body, const Vec3& point);

}  // namespace tweenfall
