#include "shapes/turned.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tweenfall::shapes {

namespace {

constexpr double turned_pi = std::numbers::pi;

/// Integrals along the axis by the three-point Gauss-Legendre rule: exact, since those of balls and cones are of
/// fourth degree. Source: Abramowitz, Stegun, Handbook of Mathematical Functions, 1964, table 25.4.
struct AxisIntegrals {
  double square = 0;        ///< of the radius squared
  double square_place = 0;  ///< times the position
  double square_arm = 0;    ///< times the square of the distance from the center
  double fourth = 0;        ///< of the radius to the fourth

  /// @param from, to  positions on the axis
  /// @param square_at  the radius squared, by the share of the way
  template <class SquareAt>
  void add(double from, double to, double center, const SquareAt& square_at) {
    const double half = 0.5 * std::sqrt(0.6);
    const std::array<double, 3> shares = {0.5 - half, 0.5, 0.5 + half}, weights = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    for (std::size_t i = 0; i < 3; ++i) {
      const double place = from + (to - from) * shares[i], weight = (to - from) * weights[i];
      const double radius_squared = square_at(shares[i]);
      square += weight * radius_squared;
      square_place += weight * radius_squared * place;
      square_arm += weight * radius_squared * (place - center) * (place - center);
      fourth += weight * radius_squared * radius_squared;
    }
  }

  void add_frustum(double from, double to, double radius_from, double radius_to, double center) {
    add(from, to, center, [&](double share) {
      const double radius = radius_from + (radius_to - radius_from) * share;
      return radius * radius;
    });
  }

  /// Adds the part of a ball between two heights.
  void add_ball(double middle, double radius, double from, double to, double center) {
    add(middle + from, middle + to, center, [&](double share) {
      const double above = from + (to - from) * share;
      return (radius - above) * (radius + above);
    });
  }
};

AxisIntegrals integrals_of(const Cylinder& cylinder, double center) {
  AxisIntegrals sums;
  sums.add_frustum(-cylinder.half_height, cylinder.half_height, cylinder.radius, cylinder.radius, center);
  return sums;
}

AxisIntegrals integrals_of(const Cone& cone, double center) {
  AxisIntegrals sums;
  sums.add_frustum(-cone.half_height, cone.half_height, cone.radius, 0, center);
  return sums;
}

/// A piece of the lower ball, a piece of a cone between the circles where it touches the balls, and a piece of
/// the upper ball.
AxisIntegrals integrals_of(const TaperedCapsule& capsule, double center) {
  const auto [sine, cosine] = taper_of(capsule);
  const double bottom = capsule.bottom_radius, top = capsule.top_radius, half = capsule.half_height;
  AxisIntegrals sums;
  sums.add_ball(-half, bottom, -bottom, sine * bottom, center);
  sums.add_frustum(-half + sine * bottom, half + sine * top, cosine * bottom, cosine * top, center);
  sums.add_ball(half, top, sine * top, top, center);
  return sums;
}

template <class Turned>
TurnedMeasures measured(const Turned& solid) {
  const AxisIntegrals about_origin = integrals_of(solid, 0);
  TurnedMeasures measures;
  measures.volume = turned_pi * about_origin.square;
  measures.center = about_origin.square_place / about_origin.square;
  const AxisIntegrals about_center = integrals_of(solid, measures.center);
  measures.along = turned_pi / 2 * about_center.fourth;
  measures.across = turned_pi / 4 * about_center.fourth + turned_pi * about_center.square_arm;
  return measures;
}

/// The farthest point along a direction on a circle about y.
Vec3 on_rim(double radius, double height, const Vec3& direction) {
  const double across = std::sqrt(direction.x() * direction.x() + direction.z() * direction.z());
  if (!(across > 0)) return {radius, height, 0};
  return {radius / across * direction.x(), height, radius / across * direction.z()};
}

}  // namespace

TurnedMeasures measures_of(const Cylinder& cylinder) noexcept {
  TurnedMeasures measures = measured(cylinder);
  measures.center = 0;
  return measures;
}
TurnedMeasures measures_of(const Cone& cone) noexcept {
  return measured(cone);
}
TurnedMeasures measures_of(const TaperedCapsule& capsule) noexcept {
  return measured(capsule);
}

Taper taper_of(const TaperedCapsule& capsule) noexcept {
  const double sine = (capsule.bottom_radius - capsule.top_radius) / (2 * capsule.half_height);
  return {sine, std::sqrt((1 - sine) * (1 + sine))};
}

Vec3 farthest(const Cylinder& cylinder, const Vec3& direction) noexcept {
  return on_rim(cylinder.radius, direction.y() < 0 ? -cylinder.half_height : cylinder.half_height, direction);
}

Vec3 farthest(const Cone& cone, const Vec3& direction) noexcept {
  const double across = std::sqrt(direction.x() * direction.x() + direction.z() * direction.z());
  if (2 * cone.half_height * direction.y() > cone.radius * across) return {0, cone.half_height, 0};
  return on_rim(cone.radius, -cone.half_height, direction);
}

Vec3 farthest(const TaperedCapsule& capsule, const Vec3& direction) noexcept {
  const double length = direction.norm();
  const bool top = capsule.half_height * direction.y() + capsule.top_radius * length >
                   -capsule.half_height * direction.y() + capsule.bottom_radius * length;
  const Vec3 center(0, top ? capsule.half_height : -capsule.half_height, 0);
  if (!(length > 0)) return center;
  return center + (top ? capsule.top_radius : capsule.bottom_radius) / length * direction;
}

double radius_of(const Cylinder& cylinder) noexcept {
  return Vec2(cylinder.radius, cylinder.half_height).norm();
}
double radius_of(const Cone& cone) noexcept {
  return std::max(1.5 * cone.half_height, Vec2(cone.radius, 0.5 * cone.half_height).norm());
}
double radius_of(const TaperedCapsule& capsule) noexcept {
  const double center = measures_of(capsule).center;
  return std::max(capsule.half_height - center + capsule.top_radius,
                  capsule.half_height + center + capsule.bottom_radius);
}

double rolling_radius(const Solid& solid, const Vec3& place, const Vec3& normal) noexcept {
  /// Sine of the angle to the side's normal within which the side itself touches.
  constexpr double on_side = 0.05;
  if (const auto* sphere = std::get_if<Sphere>(&solid)) return sphere->radius;
  if (const auto* capsule = std::get_if<Capsule>(&solid)) return capsule->radius;
  const double out = std::sqrt(normal.x() * normal.x() + normal.z() * normal.z());
  const double from_axis = std::sqrt(place.x() * place.x() + place.z() * place.z());
  if (const auto* cylinder = std::get_if<Cylinder>(&solid)) {
    return std::abs(normal.y()) <= on_side * out ? cylinder->radius : 0;
  }
  if (const auto* cone = std::get_if<Cone>(&solid)) {
    const double slant = Vec2(2 * cone->half_height, cone->radius).norm();
    const double off_side = (2 * cone->half_height * normal.y() - cone->radius * out) / slant;
    return std::abs(off_side) <= on_side ? from_axis * slant / (2 * cone->half_height) : 0;
  }
  if (const auto* capsule = std::get_if<TaperedCapsule>(&solid)) {
    const double sine = taper_of(*capsule).sine;
    if (normal.y() > sine + 1e-3) return capsule->top_radius;
    if (normal.y() < sine - 1e-3) return capsule->bottom_radius;
    const double on_axis = place.y() - normal.y() * from_axis / out;
    const double share = std::clamp(0.5 * (on_axis / capsule->half_height + 1), 0.0, 1.0);
    return capsule->bottom_radius + share * (capsule->top_radius - capsule->bottom_radius);
  }
  return 0;
}

}  // namespace tweenfall::shapes
