#include <tweenfall/curves/elementary.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <type_traits>
#include <variant>

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

bool gives_energy(const JointKind& kind) {
  return std::visit(
      [](const auto& its) {
        using Kind = std::decay_t<decltype(its)>;
        const auto is_soft = [](const std::optional<Limits>& limits) { return limits && limits->hz > 0; };
        if constexpr (requires { its.motor; })
          if (its.motor) return true;
        if constexpr (requires { its.limits.has_value(); })
          if (is_soft(its.limits)) return true;
        if constexpr (std::is_same_v<Kind, UniversalJoint>)
          return its.first_motor || its.second_motor || is_soft(its.first_limits) || is_soft(its.second_limits);
        if constexpr (std::is_same_v<Kind, SwingTwistJoint>) return its.toward.has_value() || its.twist.hz > 0;
        if constexpr (std::is_same_v<Kind, DistanceJoint>) return its.limits.hz > 0;
        return std::is_same_v<Kind, SpringJoint> || std::is_same_v<Kind, WheelJoint>;
      },
      kind);
}

}  // namespace tweenfall::joints
