#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "planar/checks.h"
#include "planar/queries/ask.h"
#include "planar/world_data.h"

namespace tweenfall::planar {

/// Access of queries to a world.
struct Questions {
  [[nodiscard]] static const World::Implementation& inside(const World& world) { return world.inside(); }

  [[nodiscard]] static inner::Figure figure(const World::Implementation& world, std::uint32_t index) {
    const inner::Body& body = world.bodies[index];
    return {world.makeups[index].plates, body.center, body.turn};
  }

  [[nodiscard]] static inner::Figure figure(const World& asked, BodyId body) {
    static_cast<void>(inside(asked).at(body));
    return figure(inside(asked), body.index);
  }

  /// Calls `ask(body, figure)` for each body that the filter lets through, by index.
  template <class Ask>
  static void each(const World& asked, const QueryFilter& filter, const Ask& ask) {
    const World::Implementation& world = inside(asked);
    for (std::uint32_t i = 0; i < world.bodies.size(); ++i) {
      const inner::Makeup& makeup = world.makeups[i];
      if (!world.bodies[i].alive || (makeup.groups & filter.groups) == 0 || (makeup.sensor && !filter.sensors))
        continue;
      const BodyId id = world.handle(i);
      if (filter.accept && !filter.accept(id)) continue;
      ask(id, figure(world, i));
    }
  }
};

namespace inner {
namespace {

/// Relative tolerance of distances within which bodies are still examined.
constexpr double slack = 1e-12;

double reach_of(const std::vector<Plate>& plates) {
  double reach = 0;
  for (const Plate& plate : plates) reach = std::max(reach, plate.reach);
  return reach;
}

/// Whether the circle around a figure comes near enough to a path to be met.
bool may_meet(const Figure& figure, const Vec2& from, const Vec2& direction, double length, double room) {
  if (figure.endless()) return true;
  const Vec2 to = figure.center - from;
  const double along = std::clamp(direction.dot(to), 0.0, length), reach = reach_of(figure.plates) + room;
  return (to - along * direction).norm() <= reach + slack * (to.norm() + reach);
}

}  // namespace
}  // namespace inner

std::optional<BodyRayHit> cast_ray(const World& world, const Vec2& from, const Vec2& direction, double length,
                                   const QueryFilter& filter) {
  inner::Ray ray = inner::checked_ray(from, direction, length);
  std::optional<BodyRayHit> first;
  Questions::each(world, filter, [&](BodyId id, const inner::Figure& figure) {
    if (!inner::may_meet(figure, ray.from, ray.direction, ray.length, 0)) return;
    const std::optional<RayHit> hit = inner::hit_by(ray, figure);
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
  Questions::each(world, filter, [&](BodyId id, const inner::Figure& figure) {
    if (!inner::may_meet(figure, ray.from, ray.direction, ray.length, 0)) return;
    if (const std::optional<RayHit> hit = inner::hit_by(ray, figure)) all.push_back({*hit, id});
  });
  std::stable_sort(all.begin(), all.end(),
                   [](const BodyRayHit& a, const BodyRayHit& b) { return a.distance < b.distance; });
  return all;
}

std::optional<BodyShapeHit> cast_shape(const World& world, const Shape& shape, const Place& start,
                                       const Vec2& displacement, const QueryFilter& filter) {
  inner::demand_numbers(displacement, "a displacement");
  const std::vector<inner::Plate> plates = inner::checked_plates(shape, start);
  inner::demand_end(shape);
  const inner::Figure moving{plates, start.position, inner::Turn::of(start.angle)};
  const double length = displacement.norm();
  const Vec2 direction = length > 0 ? Vec2(displacement / length) : Vec2(1, 0);
  std::optional<BodyShapeHit> first;
  Questions::each(world, filter, [&](BodyId id, const inner::Figure& figure) {
    if (!inner::may_meet(figure, moving.center, direction, length, inner::reach_of(plates))) return;
    const std::optional<ShapeHit> hit = inner::hit_by(moving, displacement, figure);
    if (hit && (!first || hit->fraction < first->fraction)) first = BodyShapeHit{*hit, id};
  });
  return first;
}

std::vector<BodyId> overlapping(const World& world, const Shape& shape, const Place& place, const QueryFilter& filter) {
  const std::vector<inner::Plate> plates = inner::checked_plates(shape, place);
  inner::demand_end(shape);
  const inner::Figure own{plates, place.position, inner::Turn::of(place.angle)};
  std::vector<BodyId> all;
  Questions::each(world, filter, [&](BodyId id, const inner::Figure& figure) {
    if (inner::may_meet(figure, own.center, Vec2(1, 0), 0, inner::reach_of(plates)) &&
        inner::separation_of(own, figure).distance <= 0)
      all.push_back(id);
  });
  return all;
}

std::optional<NearestBody> nearest_body(const World& world, const Vec2& point, double within,
                                        const QueryFilter& filter) {
  inner::demand_numbers(point, "a point");
  inner::demand(within >= 0, "a distance must not be negative");
  std::optional<NearestBody> nearest;
  Questions::each(world, filter, [&](BodyId id, const inner::Figure& figure) {
    const double most = nearest ? nearest->distance : within;
    if (std::isfinite(most) && !inner::may_meet(figure, point, Vec2(1, 0), 0, most)) return;
    const Separation apart = inner::separation_of(point, figure);
    if (apart.distance <= within && (!nearest || apart.distance < nearest->distance))
      nearest = NearestBody{id, apart.distance, apart.on_b};
  });
  return nearest;
}

Vec2 closest_point(const World& asked, BodyId body, const Vec2& point) {
  inner::demand_numbers(point, "a point");
  return inner::separation_of(point, Questions::figure(asked, body)).on_b;
}

}  // namespace tweenfall::planar
