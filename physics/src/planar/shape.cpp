#include <tweenfall/physics/planar_shape.h>

#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "planar/checks.h"
#include "planar/contacts/manifold.h"
#include "planar/contacts/plate.h"
#include "planar/turning.h"

namespace tweenfall::planar {

namespace inner {
namespace {

constexpr double longest = 1e30;

void require_size(double value, const char* name) {
  demand(value > 0 && value <= longest,
         std::string(name) + " must be positive and at most 1e30 m, but is " + number_text(value));
}

bool is_place(const Vec2& v) {
  return std::abs(v.x()) <= longest && std::abs(v.y()) <= longest;
}

/// Twice the area inside the corners; negative when clockwise.
double twice_area(const std::vector<Vec2>& corners) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum += cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  return sum;
}

void check(const Circle& circle) {
  require_size(circle.radius, "radius of a circle");
}
void check(const Capsule& capsule) {
  require_size(capsule.radius, "radius of a capsule");
  demand(capsule.half_height >= 0 && capsule.half_height <= longest,
         "half height of a capsule must lie in 0 to 1e30 m, but is " + number_text(capsule.half_height));
}
void check(const Box& box) {
  require_size(box.half_extents.x(), "half width of a box");
  require_size(box.half_extents.y(), "half height of a box");
}
void check(const HalfPlane& half) {
  demand(is_place(half.normal) && half.normal.squaredNorm() > 0 && std::isnormal(half.normal.norm()),
         "the normal of a half-plane must be finite and longer than 0");
  demand(std::abs(half.offset) <= longest,
         "offset of a half-plane must be finite and at most 1e30 m, but is " + number_text(half.offset));
}
void check(const Polygon& polygon) {
  const std::vector<Vec2>& corners = polygon.corners;
  const std::size_t count = corners.size();
  demand(count >= 3 && count <= Polygon::most_corners,
         "a polygon has 3 to 64 corners, but this one has " + std::to_string(count));
  for (const Vec2& corner : corners) demand(is_place(corner), "corners of a polygon must be finite and at most 1e30 m");
  const double whole = twice_area(corners);
  // Sides are too short if rounding decides which way they turn.
  double size = 0;
  for (const Vec2& corner : corners) size = std::max(size, (corner - corners[0]).norm());
  demand(std::abs(whole) > 1e-9 * size * size && whole != 0, "the corners of a polygon lie on one line");
  for (std::size_t i = 0; i < count; ++i)
    demand((corners[(i + 1) % count] - corners[i]).norm() > 1e-9 * size, "corners " + std::to_string(i) + " and " +
                                                                             std::to_string((i + 1) % count) +
                                                                             " of a polygon are one and the same");
  double around = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 in = corners[(i + 1) % count] - corners[i];
    const Vec2 out = corners[(i + 2) % count] - corners[(i + 1) % count];
    const double turned = cross(in, out) * (whole > 0 ? 1 : -1);
    demand(turned > 1e-12 * in.norm() * out.norm() || (turned >= 0 && in.dot(out) > 0),
           "the polygon is not convex at corner " + std::to_string((i + 1) % count));
    around += elementary::atan2(turned, in.dot(out));
  }
  demand(around < 1.5 * 2 * std::numbers::pi, "the corners of a polygon go round more than once");
}

bool is_angle(double angle) {
  return std::abs(angle) <= longest;
}

void check(const Compound& compound) {
  const std::size_t count = compound.parts.size();
  demand(count >= 1 && count <= Compound::most_parts, "a compound has 1 to " + std::to_string(Compound::most_parts) +
                                                          " parts, but this one has " + std::to_string(count));
  for (std::size_t i = 0; i < count; ++i) {
    const Part& part = compound.parts[i];
    const std::string which = "part " + std::to_string(i) + " of a compound: ";
    demand(is_place(part.offset) && is_angle(part.angle), which + "its place must be finite and at most 1e30");
    try {
      std::visit([](const auto& outline) { check(outline); }, part.outline);
    } catch (const std::invalid_argument& fault) {
      throw std::invalid_argument(which + fault.what());
    }
  }
}

/// Centroid and second moment about it for unit mass.
/// Source: Green's theorem; e.g. P. Bourke, Calculating the area and centroid of a polygon, 1988.
MassProperties unit_mass(const Polygon& polygon) {
  const std::vector<Vec2>& corners = polygon.corners;
  Vec2 first(0, 0);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Vec2 p = corners[i] - corners[0], q = corners[i + 1] - corners[0];
    first += cross(p, q) * (p + q) / 3;
  }
  MassProperties properties;
  properties.mass = 1;
  const double twice = twice_area(corners);
  const Vec2 centroid = first / twice;
  properties.center = corners[0] + centroid;
  // Triangles from the centroid, so that nothing has to be subtracted afterwards.
  double second = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 p = corners[i] - properties.center, q = corners[(i + 1) % corners.size()] - properties.center;
    second += cross(p, q) * (p.squaredNorm() + p.dot(q) + q.squaredNorm()) / 6;
  }
  properties.moment = second / twice;
  return properties;
}
MassProperties unit_mass(const Circle& circle) {
  return {1, Vec2(0, 0), 0.5 * circle.radius * circle.radius};
}
MassProperties unit_mass(const Box& box) {
  return {1, Vec2(0, 0), box.half_extents.squaredNorm() / 3};
}
MassProperties unit_mass(const Capsule& capsule) {
  const double r = capsule.radius, h = capsule.half_height;
  const double straight = 4 * r * h, round = std::numbers::pi * r * r, all = straight + round;
  // Two half circles, each with its center of mass 4 r / (3 pi) beyond the middle of its flat side.
  const double off = 4 * r / (3 * std::numbers::pi);
  const double half_disc = 0.5 * r * r - off * off + (h + off) * (h + off);
  return {1, Vec2(0, 0), (straight * (r * r + h * h) / 3 + round * half_disc) / all};
}
MassProperties unit_mass(const Compound& compound);
MassProperties unit_mass(const HalfPlane&) {
  throw std::invalid_argument("a half-plane has no mass: only fixed and keyed bodies can be one");
}

double area_of(const Circle& circle) {
  return std::numbers::pi * circle.radius * circle.radius;
}
double area_of(const Capsule& capsule) {
  return capsule.radius * (4 * capsule.half_height + std::numbers::pi * capsule.radius);
}
double area_of(const Box& box) {
  return 4 * box.half_extents.x() * box.half_extents.y();
}
double area_of(const Polygon& polygon) {
  return 0.5 * std::abs(twice_area(polygon.corners));
}
double area_of(const HalfPlane&) {
  return std::numeric_limits<double>::infinity();
}
double area_of(const Part& part) {
  return std::visit([](const auto& outline) { return area_of(outline); }, part.outline);
}
double area_of(const Compound& compound) {
  double sum = 0;
  for (const Part& part : compound.parts) sum += area_of(part);
  return sum;
}

/// Each part by its share of the area, by the parallel-axis theorem.
MassProperties unit_mass(const Compound& compound) {
  const double whole = area_of(compound);
  std::vector<MassProperties> parts;
  MassProperties sum;
  sum.mass = 1;
  for (const Part& part : compound.parts) {
    MassProperties its = std::visit([](const auto& outline) { return unit_mass(outline); }, part.outline);
    its.mass = area_of(part) / whole;
    its.center = part.offset + Turn::of(part.angle) * its.center;
    sum.center += its.mass * its.center;
    parts.push_back(its);
  }
  for (const MassProperties& its : parts)
    sum.moment += its.mass * (its.moment + (its.center - sum.center).squaredNorm());
  return sum;
}

std::vector<Vec2> corners_of(const Circle&) {
  return {Vec2(0, 0)};
}
std::vector<Vec2> corners_of(const Capsule& capsule) {
  if (capsule.half_height == 0) return {Vec2(0, 0)};
  return {Vec2(0, -capsule.half_height), Vec2(0, capsule.half_height)};
}
std::vector<Vec2> corners_of(const Box& box) {
  const double x = box.half_extents.x(), y = box.half_extents.y();
  return {Vec2(-x, -y), Vec2(x, -y), Vec2(x, y), Vec2(-x, y)};
}
std::vector<Vec2> corners_of(const Polygon& polygon) {
  std::vector<Vec2> corners = polygon.corners;
  if (twice_area(corners) < 0) std::reverse(corners.begin(), corners.end());
  return corners;
}

template <class Outline>
double skin_of(const Outline& outline) {
  if (const auto* circle = std::get_if<Circle>(&outline)) return circle->radius;
  if (const auto* capsule = std::get_if<Capsule>(&outline)) return capsule->radius;
  return 0;
}

}  // namespace

namespace {

/// For a part that is placed on the node.
Plate plate_of(const Part& placed, const Vec2& center) {
  Plate plate;
  plate.skin = skin_of(placed.outline);
  const Turn turn = Turn::of(placed.angle);
  for (const Vec2& corner : std::visit([](const auto& outline) { return corners_of(outline); }, placed.outline))
    plate.corners.push_back({placed.offset + turn * corner - center, Vec2(0, 0)});
  const std::size_t count = plate.corners.size();
  for (std::size_t i = 0; i < count && count > 1; ++i) {
    const Vec2 side = plate.corners[(i + 1) % count].at - plate.corners[i].at;
    plate.corners[i].normal = (-quarter(side)).normalized();
  }
  const Vec2 own = std::visit([](const auto& outline) { return unit_mass(outline); }, placed.outline).center;
  plate.middle = placed.offset + turn * own - center;
  plate.least = std::numeric_limits<double>::infinity();
  for (const Corner& corner : plate.corners) {
    const Vec2 at = corner.at - plate.middle;
    plate.reach = std::max(plate.reach, corner.at.norm());
    plate.size = std::max(plate.size, at.norm());
    plate.least = std::min(plate.least, count > 2 ? at.dot(corner.normal) : 0.0);
  }
  for (double* const length : {&plate.reach, &plate.size, &plate.least}) *length += plate.skin;
  return plate;
}

Plate endless_plate(const HalfPlane& half, const Shape& shape, const Vec2& center) {
  Plate plate;
  const Turn turn = Turn::of(shape.angle);
  const Vec2 normal = half.normal.normalized();
  plate.endless = true;
  plate.corners.push_back({shape.offset + turn * Vec2(half.offset * normal) - center, turn * normal});
  plate.reach = plate.least = plate.size = std::numeric_limits<double>::infinity();
  return plate;
}

/// For a shape that is not endless, placed on the node.
struct PartsOf {
  const Shape& shape;

  std::vector<Part> operator()(const Compound& compound) const {
    std::vector<Part> parts = compound.parts;
    for (Part& part : parts) {
      part.offset = shape.offset + Turn::of(shape.angle) * part.offset;
      part.angle += shape.angle;
    }
    return parts;
  }
  std::vector<Part> operator()(const HalfPlane&) const { return {}; }
  template <class Single>
  std::vector<Part> operator()(const Single& outline) const {
    return {{outline, shape.offset, shape.angle}};
  }
};

}  // namespace

std::vector<Plate> plates_of(const Shape& shape, const Vec2& center) {
  if (const auto* const half = std::get_if<HalfPlane>(&shape.outline)) return {endless_plate(*half, shape, center)};
  std::vector<Plate> plates;
  for (const Part& part : std::visit(PartsOf{shape}, shape.outline)) plates.push_back(plate_of(part, center));
  return plates;
}

}  // namespace inner

void validate(const Shape& shape) {
  std::visit([](const auto& outline) { inner::check(outline); }, shape.outline);
  inner::demand(inner::is_place(shape.offset), "offset of a shape must be finite and at most 1e30 m");
  inner::demand(inner::is_angle(shape.angle), "angle of a shape must be finite and at most 1e30 rad");
}

double area(const Outline& outline) {
  return std::visit([](const auto& its) { return inner::area_of(its); }, outline);
}

MassProperties mass_properties(const Shape& shape, double mass) {
  validate(shape);
  inner::demand(mass > 0 && mass <= inner::longest,
                "mass must be positive and at most 1e30 kg, but is " + number_text(mass));
  MassProperties properties = std::visit([](const auto& outline) { return inner::unit_mass(outline); }, shape.outline);
  properties.mass = mass;
  properties.moment *= mass;
  properties.center = shape.offset + inner::Turn::of(shape.angle) * properties.center;
  return properties;
}

Manifold collide(const Shape& a, const Place& place_a, const Shape& b, const Place& place_b, double margin) {
  validate(a);
  validate(b);
  const inner::Turn turn_a = inner::Turn::of(place_a.angle), turn_b = inner::Turn::of(place_b.angle);
  const std::vector<inner::Plate> plates_a = inner::plates_of(a, Vec2(0, 0)),
                                  plates_b = inner::plates_of(b, Vec2(0, 0));
  Manifold manifold;
  double most = -std::numeric_limits<double>::infinity();
  for (const inner::Plate& plate_a : plates_a)
    for (const inner::Plate& plate_b : plates_b) {
      const inner::Found found =
          inner::find_manifold({&plate_a, place_a.position, turn_a}, {&plate_b, place_b.position, turn_b}, margin);
      double depth = -std::numeric_limits<double>::infinity();
      for (int i = 0; i < found.count; ++i) depth = std::max(depth, -found.points[static_cast<std::size_t>(i)].gap);
      if (!(depth > most)) continue;
      most = depth;
      manifold.normal = found.normal;
      manifold.count = found.count;
      for (int i = 0; i < found.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const inner::FoundPoint& point = found.points[k];
        const Vec2 on_a = place_a.position + point.core_a + plate_a.skin * found.normal;
        const Vec2 on_b = place_b.position + point.core_b - plate_b.skin * found.normal;
        manifold.points[k] = {0.5 * (on_a + on_b), -point.gap, point.feature};
      }
    }
  return manifold;
}

}  // namespace tweenfall::planar
