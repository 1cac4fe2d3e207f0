#include "figures/turned_profile.h"

#include <tweenfall/curves/elementary.h>

#include <numbers>

namespace tweenfall::figures {

namespace {

std::vector<ProfilePoint> profile_of(const Cylinder& cylinder) {
  const double radius = cylinder.radius, half = cylinder.half_height;
  return {{0, half, 0, 1},       {radius, half, 0, 1},   {radius, half, 1, 0},
          {radius, -half, 1, 0}, {radius, -half, 0, -1}, {0, -half, 0, -1}};
}

std::vector<ProfilePoint> profile_of(const Cone& cone) {
  const double radius = cone.radius, half = cone.half_height;
  const Vec2 side = Vec2(2 * half, radius).normalized();
  return {
      {0, half, side.x(), side.y()}, {radius, -half, side.x(), side.y()}, {radius, -half, 0, -1}, {0, -half, 0, -1}};
}

std::vector<ProfilePoint> profile_of(const TaperedCapsule& capsule) {
  constexpr int steps = 8;  // of each ball, from its pole to where the side begins
  const double sine = (capsule.bottom_radius - capsule.top_radius) / (2 * capsule.half_height);
  const double side = elementary::acos(sine);  // from the upper pole
  std::vector<ProfilePoint> profile;
  const auto add = [&](double angle, double radius, double lift) {
    const auto [sine_of, up] = elementary::sin_cos(angle);
    const double out = angle > 0 && angle < std::numbers::pi ? sine_of : 0;
    profile.push_back({radius * out, radius * up + lift, out, up});
  };
  for (int i = 0; i <= steps; ++i) add(side * i / steps, capsule.top_radius, capsule.half_height);
  for (int i = 0; i <= steps; ++i)
    add(side + (std::numbers::pi - side) * i / steps, capsule.bottom_radius, -capsule.half_height);
  return profile;
}

}  // namespace

std::vector<ProfilePoint> turned_profile(const Solid& solid) {
  if (const auto* cylinder = std::get_if<Cylinder>(&solid)) return profile_of(*cylinder);
  if (const auto* cone = std::get_if<Cone>(&solid)) return profile_of(*cone);
  if (const auto* tapered = std::get_if<TaperedCapsule>(&solid)) return profile_of(*tapered);
  return {};
}

}  // namespace tweenfall::figures
