#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "planar/checks.h"
#include "planar/queries/ask.h"
#include "planar/world_data.h"

namespace tweenfall::planar {

/// What questions see of a world.
struct Questions {
  [[nodiscard]] static const World::Implementation& inside(const World& world) { return *world.implementation_; }

  [[nodiscard]] static inner::Placed placed(const World::Implementation& world, std::uint32_t index) {
    const inner::Body& body = world.bodies[index];
    return {&world.makeups[index].plate, body.center, body.turn};
  }

  [[nodiscard]] static inner::Placed placed(const World& asked, BodyId body) {
    static_cast<void>(inside(asked).at(body));
    return placed(inside(asked), body.index);
  }

  /// `ask(body, placed)` for each that the filter lets through, by index.
  template <class Ask>
  static void each(const World& asked, const QueryFilter& filter, const Ask& ask) {
    const World::Implementation& world = inside(asked);
    for (std::uint32_t i = 0; i < world.bodies.size(); ++i) {
      const inner::Makeup& makeup = world.makeups[i];
      if (!world.bodies[i].alive || (makeup.groups & filter.groups) == 0 || (makeup.sensor && !filter.sensors))
        continue;
      const BodyId id = world.handle(i);
      if (filter.accept && !filter.accept(id)) continue;
      ask(id, placed(world, i));
    }
  }
};

namespace inner {
namespace {

/// What is farther from a point than this by no more is looked at all the same: parts of the distance.
constexpr double slack = 1e-12;

/// Whether a circle about what is placed comes near enough to a way to be met.
bool may_meet(const Placed& placed, const Vec2& from, const Vec2& direction, double length, double room) {
  if (placed.plate->endless) return true;
  const Vec2 to = placed.center - from;
  const double along = std::clamp(direction.dot(to), 0.0, length), reach = placed.plate->reach + room;
  return (to - along * direction).norm() <= reach + slack * (to.norm() + reach);
}

}  // namespace
}  // namespace inner

std::optional<BodyRayHit> cast_ray(const World& world, const Vec2& from, const Vec2& direction, double length,
                                   const QueryFilter& filter) {
  inner::Ray ray = inner::checked_ray(from, direction, length);
  std::optional<BodyRayHit> first;
  Questions::each(world, filter, [&](BodyId id, const inner::Placed& placed) {
    if (!inner::may_meet(placed, ray.from, ray.direction, ray.length, 0)) return;
    const std::optional<RayHit> hit = inner::hit_by(ray, placed);
    if (!hit || (first && hit->distance >= first->distance)) return;
    first = BodyRayHit{*hit, id};
    ray.length = hit->distance;
  });
  return first;
}

std::vector<BodyRayHit> cast_ray_through(const World& world, const Vec2& from, const Vec2& direction, double length,
                                         const QueryFilter& filter) {
  const inner::Ray ray = inner::checked_ray(from, direction, length);
  std::vector<BodyRayHit> all;
  Questions::each(world, filter, [&](BodyId id, const inner::Placed& placed) {
    if (!inner::may_meet(placed, ray.from, ray.direction, ray.length, 0)) return;
    if (const std::optional<RayHit> hit = inner::hit_by(ray, placed)) all.push_back({*hit, id});
  });
  std::stable_sort(all.begin(), all.end(),
                   [](const BodyRayHit& a, const BodyRayHit& b) { return a.distance < b.distance; });
  return all;
}

std::optional<BodyShapeHit> cast_shape(const World& world, const Shape& shape, const Place& start,
                                       const Vec2& displacement, const QueryFilter& filter) {
  inner::demand_numbers(displacement, "a displacement");
  const inner::Plate plate = inner::checked_plate(shape, start);
  inner::demand_end(shape);
  const inner::Placed moving{&plate, start.position, inner::Turn::of(start.angle)};
  const double length = displacement.norm();
  const Vec2 direction = length > 0 ? Vec2(displacement / length) : Vec2(1, 0);
  std::optional<BodyShapeHit> first;
  Questions::each(world, filter, [&](BodyId id, const inner::Placed& placed) {
    if (!inner::may_meet(placed, moving.center, direction, length, plate.reach)) return;
    const std::optional<ShapeHit> hit = inner::hit_by(moving, displacement, placed);
    if (hit && (!first || hit->fraction < first->fraction)) first = BodyShapeHit{*hit, id};
  });
  return first;
}

std::vector<BodyId> overlapping(const World& world, const Shape& shape, const Place& place, const QueryFilter& filter) {
  const inner::Plate plate = inner::checked_plate(shape, place);
  inner::demand_end(shape);
  const inner::Placed own{&plate, place.position, inner::Turn::of(place.angle)};
  std::vector<BodyId> all;
  Questions::each(world, filter, [&](BodyId id, const inner::Placed& placed) {
    if (inner::may_meet(placed, own.center, Vec2(1, 0), 0, plate.reach) &&
        inner::separation_of(own, placed).distance <= 0)
      all.push_back(id);
  });
  return all;
}

std::optional<NearestBody> nearest_body(const World& world, const Vec2& point, double within,
                                        const QueryFilter& filter) {
  inner::demand_numbers(point, "a point");
  inner::demand(within >= 0, "a distance must not be negative");
  std::optional<NearestBody> nearest;
  Questions::each(world, filter, [&](BodyId id, const inner::Placed& placed) {
    const double most = nearest ? nearest->distance : within;
    if (std::isfinite(most) && !inner::may_meet(placed, point, Vec2(1, 0), 0, most)) return;
    const Separation apart = inner::separation_of(point, placed);
    if (apart.distance <= within && (!nearest || apart.distance < nearest->distance))
      nearest = NearestBody{id, apart.distance, apart.on_b};
  });
  return nearest;
}

Vec2 closest_point(const World& asked, BodyId body, const Vec2& point) {
  inner::demand_numbers(point, "a point");
  return inner::separation_of(point, Questions::placed(asked, body)).on_b;
}

}  // namespace tweenfall::planar
