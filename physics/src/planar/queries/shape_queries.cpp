#include <algorithm>
#include <cmath>

#include "planar/checks.h"
#include "planar/queries/ask.h"

namespace tweenfall::planar {

namespace inner {

namespace {

/// Relative to a size, and to a coordinate: a gap that counts as none.
constexpr double met_size = 1e-13, met_place = 1e-15;

Figure on_node(const std::vector<Plate>& plates, const Place& place) {
  return {plates, place.position, Turn::of(place.angle)};
}

void demand_place(const Place& place) {
  demand_numbers(place.position, "a position");
  demand_number(place.angle, "an angle");
}

bool is_endless(const Shape& shape) {
  return std::holds_alternative<HalfPlane>(shape.outline);
}

Plate point_plate() {
  Plate plate;
  plate.corners.push_back({Vec2(0, 0), Vec2(0, 0)});
  return plate;
}

std::optional<RayHit> hit_by(const Ray& ray, const Placed& placed) {
  const Plate point = point_plate();
  const Difference difference({&point, ray.from, Turn{}}, placed);
  const Difference::Nearest nearest = difference.nearest();
  if (nearest.gap <= 0) return RayHit{0, ray.from, -ray.direction, true};
  const std::optional<Difference::Met> met = difference.met(ray.direction, ray.length);
  if (!met) return std::nullopt;
  return RayHit{met->way, ray.from + met->way * ray.direction, met->normal, false};
}

std::optional<ShapeHit> hit_by(const Placed& moving, const Vec2& displacement, const Placed& placed) {
  const Difference difference(moving, placed);
  const Difference::Nearest nearest = difference.nearest();
  const auto size_of = [](const Placed& one) { return one.plate->endless ? 0 : one.plate->reach; };
  const double none = met_size * (size_of(moving) + size_of(placed)) +
                      met_place * (moving.center.cwiseAbs().sum() + placed.center.cwiseAbs().sum());
  const Vec2 touching = nearest.on_b + placed.plate->skin * nearest.normal;
  if (nearest.gap < -none) return ShapeHit{0, nearest.common.value_or(touching), nearest.normal, true};
  const double size = displacement.cwiseAbs().maxCoeff();
  if (!(size > 0)) return std::nullopt;
  const Vec2 direction = (displacement / size).normalized();
  if (nearest.gap <= none) {
    if (!(nearest.normal.dot(direction) < 0)) return std::nullopt;
    return ShapeHit{0, touching, nearest.normal, false};
  }
  const double length = size * (displacement / size).norm();
  const std::optional<Difference::Met> met = difference.met(direction, length);
  if (!met) return std::nullopt;
  return ShapeHit{std::min(1.0, met->way / length), met->point, met->normal, false};
}

Separation separation_of(const Placed& a, const Placed& b) {
  const Difference::Nearest nearest = Difference(a, b).nearest();
  if (nearest.common) return {0, *nearest.common, *nearest.common};
  const double skin_a = a.plate->skin, skin_b = b.plate->skin;
  if (nearest.gap > 0)
    return {nearest.gap, nearest.on_a - skin_a * nearest.normal, nearest.on_b + skin_b * nearest.normal};
  // Only the skins overlap: a point between the cores is in both.
  const double part = skin_a + skin_b > 0 ? skin_a / (skin_a + skin_b) : 0;
  const Vec2 common = nearest.on_a + part * (nearest.on_b - nearest.on_a);
  return {0, common, common};
}

}  // namespace

std::vector<Plate> checked_plates(const Shape& shape, const Place& place) {
  validate(shape);
  demand_place(place);
  return plates_of(shape, Vec2(0, 0));
}

void demand_end(const Shape& shape) {
  demand(!is_endless(shape), "a half-plane is infinite: ask with a finite shape");
}

Ray checked_ray(const Vec2& from, const Vec2& direction, double length) {
  demand_numbers(from, "start of a ray");
  demand_numbers(direction, "direction of a ray");
  const double size = direction.cwiseAbs().maxCoeff();
  demand(size > 0, "direction of a ray must be longer than 0");
  demand(length >= 0, "length of a ray must not be negative");
  return {from, Vec2((direction / size).normalized()), length};
}

std::optional<RayHit> hit_by(const Ray& ray, const Figure& figure) {
  std::optional<RayHit> first;
  for (const Plate& plate : figure.plates)
    if (const std::optional<RayHit> hit = hit_by(ray, figure.placed(plate));
        hit && (!first || hit->distance < first->distance))
      first = hit;
  return first;
}

/// Of parts that overlap from the start, the first is reported.
std::optional<ShapeHit> hit_by(const Figure& moving, const Vec2& displacement, const Figure& figure) {
  std::optional<ShapeHit> first;
  for (const Plate& own : moving.plates)
    for (const Plate& plate : figure.plates) {
      const std::optional<ShapeHit> hit = hit_by(moving.placed(own), displacement, figure.placed(plate));
      if (!hit || (first && (first->inside || (!hit->inside && hit->fraction >= first->fraction)))) continue;
      first = hit;
    }
  return first;
}

Separation separation_of(const Figure& a, const Figure& b) {
  std::optional<Separation> nearest;
  for (const Plate& own : a.plates)
    for (const Plate& plate : b.plates)
      if (const Separation apart = separation_of(a.placed(own), b.placed(plate));
          !nearest || apart.distance < nearest->distance)
        nearest = apart;
  return *nearest;
}

Separation separation_of(const Vec2& point, const Figure& b) {
  const std::vector<Plate> dot{point_plate()};
  const Separation apart = separation_of(Figure{dot, point, Turn{}}, b);
  return apart.distance > 0 ? apart : Separation{0, point, point};
}

}  // namespace inner

std::optional<RayHit> cast_ray(const Shape& shape, const Place& place, const Vec2& from, const Vec2& direction,
                               double length) {
  const std::vector<inner::Plate> plates = inner::checked_plates(shape, place);
  return inner::hit_by(inner::checked_ray(from, direction, length), inner::on_node(plates, place));
}

std::optional<ShapeHit> cast_shape(const Shape& moving, const Place& start, const Vec2& displacement,
                                   const Shape& shape, const Place& place) {
  inner::demand_numbers(displacement, "a displacement");
  const std::vector<inner::Plate> one = inner::checked_plates(moving, start),
                                  other = inner::checked_plates(shape, place);
  if (inner::is_endless(moving)) inner::demand_end(shape);
  return inner::hit_by(inner::on_node(one, start), displacement, inner::on_node(other, place));
}

Separation distance(const Shape& a, const Place& place_a, const Shape& b, const Place& place_b) {
  const std::vector<inner::Plate> one = inner::checked_plates(a, place_a), other = inner::checked_plates(b, place_b);
  if (inner::is_endless(a)) inner::demand_end(b);
  return inner::separation_of(inner::on_node(one, place_a), inner::on_node(other, place_b));
}

bool overlapping(const Shape& a, const Place& place_a, const Shape& b, const Place& place_b) {
  return distance(a, place_a, b, place_b).distance <= 0;
}

Vec2 closest_point(const Shape& shape, const Place& place, const Vec2& point) {
  inner::demand_numbers(point, "a point");
  const std::vector<inner::Plate> plates = inner::checked_plates(shape, place);
  return inner::separation_of(point, inner::on_node(plates, place)).on_b;
}

}  // namespace tweenfall::planar
