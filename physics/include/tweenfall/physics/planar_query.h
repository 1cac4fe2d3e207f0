#pragma once

/// Queries about where shapes and bodies in a plane are: rays, moving shapes, overlaps, distances, as in `query.h`
/// for space. Answers are in closed form, to rounding: every query is answered on the Minkowski difference of the two
/// shapes, which is a convex polygon with a round skin.
/// Source: Ericson, Real-Time Collision Detection, 2005, 3.11 (Minkowski sums), 5.3 (rays).
///
/// Nothing here changes a world, and anything added, moved or removed since its last step counts at once. A shape is
/// closed: its outline belongs to it. Queries on a world look at each of its bodies.

#include <tweenfall/physics/planar_world.h>
#include <tweenfall/physics/query.h>

#include <limits>
#include <optional>
#include <vector>

namespace tweenfall::planar {

// Two shapes, each on a node at its place

struct RayHit {
  double distance = 0;  ///< along the ray, m
  Vec2 point{0, 0};     ///< world
  Vec2 normal{0, 1};    ///< unit, out of the shape; against the ray where the ray starts inside
  bool inside = false;  ///< the ray starts in the shape: it is hit at once, at its start
};

/// Where a ray first meets a shape.
/// @param direction  of any length but 0
/// @param length     m; may be infinite
/// @throws std::invalid_argument for a direction of length 0, a negative length, numbers that are not finite or beyond
/// 1e30, or an impossible shape; likewise for all functions below
[[nodiscard]] std::optional<RayHit> cast_ray(const Shape& shape, const Place& place, const Vec2& from,
                                             const Vec2& direction,
                                             double length = std::numeric_limits<double>::infinity());

struct ShapeHit {
  double fraction = 0;  ///< the free part of the displacement, 0 to 1
  Vec2 point{0, 0};     ///< where the two touch then, world
  Vec2 normal{0, 1};    ///< unit, out of the shape that was hit
  bool inside = false;  ///< the two overlap from the start; the normal is then the shortest way out
};

/// How far `moving` gets, without turning, until it hits `shape`. Touching and parting, or sliding along, is no hit.
/// @throws std::invalid_argument also for two half-planes
[[nodiscard]] std::optional<ShapeHit> cast_shape(const Shape& moving, const Place& start, const Vec2& displacement,
                                                 const Shape& shape, const Place& place);

struct Separation {
  double distance = 0;  ///< m; 0 where they touch or overlap
  Vec2 on_a{0, 0};      ///< the nearest points, world; for overlapping shapes, one common point
  Vec2 on_b{0, 0};
};

/// The gap between two shapes. @throws std::invalid_argument also for two half-planes
[[nodiscard]] Separation distance(const Shape& a, const Place& place_a, const Shape& b, const Place& place_b);
[[nodiscard]] bool overlapping(const Shape& a, const Place& place_a, const Shape& b, const Place& place_b);

/// The point of a shape that is nearest to `point`: `point` itself where it is inside.
[[nodiscard]] Vec2 closest_point(const Shape& shape, const Place& place, const Vec2& point);

// All bodies of a world

struct BodyRayHit : RayHit {
  BodyId body;
};
struct BodyShapeHit : ShapeHit {
  BodyId body;
};
struct NearestBody {
  BodyId body;
  double distance = 0;  ///< m; 0 inside
  Vec2 point{0, 0};     ///< of the body, world
};

/// The first body that a ray hits; of several at the same distance, the one with the smallest index.
[[nodiscard]] std::optional<BodyRayHit> cast_ray(const World& world, const Vec2& from, const Vec2& direction,
                                                 double length = std::numeric_limits<double>::infinity(),
                                                 const QueryFilter& filter = {});
/// All bodies on the ray, each where the ray first hits it, by distance and then by index.
[[nodiscard]] std::vector<BodyRayHit> cast_ray_through(const World& world, const Vec2& from, const Vec2& direction,
                                                       double length = std::numeric_limits<double>::infinity(),
                                                       const QueryFilter& filter = {});
/// The first body that the shape hits on its way; the shape may not be a half-plane.
[[nodiscard]] std::optional<BodyShapeHit> cast_shape(const World& world, const Shape& shape, const Place& start,
                                                     const Vec2& displacement, const QueryFilter& filter = {});
/// The bodies that touch or overlap the shape, by index; the shape may not be a half-plane.
[[nodiscard]] std::vector<BodyId> overlapping(const World& world, const Shape& shape, const Place& place,
                                              const QueryFilter& filter = {});
/// The body nearest to a point, if one is no farther away than `within`; of several, the one with the smallest index.
[[nodiscard]] std::optional<NearestBody> nearest_body(const World& world, const Vec2& point,
                                                      double within = std::numeric_limits<double>::infinity(),
                                                      const QueryFilter& filter = {});
/// The point of one body that is nearest to `point`. @throws std::invalid_argument for a stale handle too
[[nodiscard]] Vec2 closest_point(const World& world, BodyId body, const Vec2& point);

}  // namespace tweenfall::planar
