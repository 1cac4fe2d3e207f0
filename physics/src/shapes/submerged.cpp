#include "shapes/submerged.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "shapes/turned.h"

namespace tweenfall::shapes {

namespace {

constexpr std::size_t most_corners_of_box_face = 4;

/// Sums the part of a closed surface of polygons that is below a plane, as pyramids from a point of the plane: the
/// face in the plane that closes this part has no volume.
/// Source: Mirtich, Fast and accurate computation of polyhedral mass properties, 1996.
class CutPolyhedron {
 public:
  CutPolyhedron(const Vec3& normal, double level, const Vec3& near)
      : normal_(normal), level_(level), tip_(near + (level - normal.dot(near)) * normal) {}

  template <class Corner>
  void add_face(std::size_t count, const Corner& corner) {
    Vec3 before = corner(count - 1);
    double depth_before = depth(before);
    Vec3 first = Vec3::Zero(), last = Vec3::Zero();
    std::size_t kept = 0;
    const auto keep = [&](const Vec3& point) {
      if (kept == 0) first = point;
      if (kept > 1) add(first, last, point);
      last = point;
      ++kept;
    };
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 here = corner(i);
      const double depth_here = depth(here);
      if ((depth_here > 0) != (depth_before > 0))
        keep(before + depth_before / (depth_before - depth_here) * (here - before));
      if (depth_here > 0) keep(here);
      before = here;
      depth_before = depth_here;
    }
  }
  [[nodiscard]] Moments sum() const { return {volume_, volume_ * tip_ + first_}; }

 private:
  [[nodiscard]] double depth(const Vec3& point) const { return level_ - normal_.dot(point); }
  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 to_a = a - tip_, to_b = b - tip_, to_c = c - tip_;
    const double six = to_a.dot(to_b.cross(to_c));
    volume_ += six / 6;
    first_ += six / 24 * (to_a + to_b + to_c);
  }

  const Vec3& normal_;
  double level_;
  Vec3 tip_;
  double volume_ = 0;
  Vec3 first_{0, 0, 0};  ///< about the tip of the pyramids
};

Moments under(const Sphere& sphere, const Vec3& normal, double level) {
  const double radius = sphere.radius, height = std::clamp(radius + level, 0.0, 2 * radius);
  // A cap of this height: pi h^2 (3 r - h) / 3, and its moment -pi h^2 (2 r - h)^2 / 4 along the normal.
  const double volume = std::numbers::pi * height * height * (3 * radius - height) / 3;
  const double rest = 2 * radius - height;
  return {volume, -std::numbers::pi / 4 * height * height * rest * rest * normal};
}

Moments under(const Box& box, const Vec3& normal, double level) {
  CutPolyhedron cut(normal, level, Vec3::Zero());
  constexpr std::array<std::array<int, 2>, most_corners_of_box_face> around{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1})
      cut.add_face(around.size(), [&](std::size_t i) {
        // Counter-clockwise from outside: the other way around on the far side.
        const std::array<int, 2>& at = around[side > 0 ? i : around.size() - 1 - i];
        Vec3 corner;
        corner[axis] = side * box.half_extents[axis];
        corner[(axis + 1) % 3] = at[0] * box.half_extents[(axis + 1) % 3];
        corner[(axis + 2) % 3] = at[1] * box.half_extents[(axis + 2) % 3];
        return corner;
      });
  return cut.sum();
}

Moments under(const Hull& hull, const Vec3& normal, double level) {
  CutPolyhedron cut(normal, level, hull.convex.measures().center);
  for (const ConvexHull::Face& face : hull.convex.faces()) {
    const std::span<const std::uint32_t> corners = hull.convex.corners(face);
    cut.add_face(corners.size(), [&](std::size_t i) { return Vec3(hull.convex.vertices()[corners[i]]); });
  }
  return cut.sum();
}

Moments sum_of(std::span<const Round> rounds, const Vec3& normal, double level) {
  Moments sum;
  for (const Round& round : rounds) {
    if (!(round.high > round.low)) continue;
    const Moments part = submerged(round, normal, level);
    sum.volume += part.volume;
    sum.first += part.first;
  }
  return sum;
}

Moments under(const Cylinder& cylinder, const Vec3& normal, double level) {
  const std::array<Round, 1> rounds{
      {{-cylinder.half_height, cylinder.half_height, cylinder.radius * cylinder.radius, 0, 0}}};
  return sum_of(rounds, normal, level);
}

Moments under(const Cone& cone, const Vec3& normal, double level) {
  const double slope = cone.radius / (2 * cone.half_height), square = slope * slope;
  const std::array<Round, 1> rounds{{{-cone.half_height, cone.half_height, square * cone.half_height * cone.half_height,
                                      -2 * square * cone.half_height, square}}};
  return sum_of(rounds, normal, level);
}

Moments under(const TaperedCapsule& capsule, const Vec3& normal, double level) {
  const Taper taper = taper_of(capsule);
  const auto ball = [](double middle, double radius, double low, double high) -> Round {
    return {low, high, radius * radius - middle * middle, 2 * middle, -1};
  };
  // The side touches the balls where its normal, which rises by the sine, leaves them.
  const double low = -capsule.half_height + taper.sine * capsule.bottom_radius;
  const double high = capsule.half_height + taper.sine * capsule.top_radius;
  const double at_low = taper.cosine * capsule.bottom_radius, at_high = taper.cosine * capsule.top_radius;
  const double slope = (at_high - at_low) / (high - low), base = at_low - slope * low;
  const std::array<Round, 3> rounds{
      {ball(-capsule.half_height, capsule.bottom_radius, -capsule.half_height - capsule.bottom_radius, low),
       {low, high, base * base, 2 * base * slope, slope * slope},
       ball(capsule.half_height, capsule.top_radius, high, capsule.half_height + capsule.top_radius)}};
  return sum_of(rounds, normal, level);
}

Moments under(const Capsule& capsule, const Vec3& normal, double level) {
  if (capsule.half_height == 0) return under(Sphere{capsule.radius}, normal, level);
  return under(TaperedCapsule{capsule.radius, capsule.radius, capsule.half_height}, normal, level);
}

Moments under(const Compound& compound, const Vec3& normal, double level) {
  Moments sum;
  for (const Shape& part : compound.parts()) {
    const Submerged one = submerged(part, normal, level);
    sum.volume += one.volume;
    sum.first += one.volume * one.center;
  }
  return sum;
}

// Scenery displaces no liquid.
template <class Scenery>
Moments under(const Scenery&, const Vec3&, double) {
  return {};
}

}  // namespace

Submerged submerged(const Shape& shape, const Vec3& normal, double level) {
  const Vec3 own = shape.offset.rotation.conjugate() * normal;
  const Moments part = std::visit(
      [&](const auto& solid) { return under(solid, own, level - normal.dot(shape.offset.position)); }, shape.solid);
  const double whole = volume(shape.solid);
  if (!(part.volume > 1e-15 * whole)) return {};
  Submerged result;
  constexpr double rounding = 1e-12;
  result.volume = part.volume > whole * (1 - rounding) ? whole : part.volume;
  result.share = result.volume / whole;
  result.center = shape.offset.position + shape.offset.rotation * Vec3(part.first / part.volume);
  return result;
}

}  // namespace tweenfall::shapes
