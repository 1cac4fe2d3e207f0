#include <tweenfall/curves/elementary.h>

#include <cmath>
#include <numbers>

#include "joints/kinds/kinds.h"

namespace tweenfall::joints {

double unwrapped(double angle, double last) {
  constexpr double turn = 2 * std::numbers::pi;
  return angle + turn * std::nearbyint((last - angle) / turn);
}

double twist_of(const Quat& rotation) {
  // Both signs of a quaternion are the same rotation: the one with w >= 0 gives the short angle.
  const double sign = rotation.w() < 0 ? -1 : 1;
  return 2 * elementary::atan2(sign * rotation.x(), sign * rotation.w());
}

Coordinates coordinates_of(const state::Joint& joint, const Placement& at) {
  return std::visit([&](const auto& kind) { return coordinates_of(kind, joint, at); }, joint.settings.kind);
}

}  // namespace tweenfall::joints
