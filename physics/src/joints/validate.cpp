#include "joints/validate.h"

#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/rotation.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "state/countable.h"

namespace tweenfall::joints {

namespace {

constexpr double half_turn = std::numbers::pi;

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument(what);
}

void require_amount(double value, const std::string& name) {
  require(value >= 0 && state::countable(value), name + " must lie in 0 to 1e30, but is " + number_text(value));
}

void require_finite(const Vec3& value, const std::string& name) {
  require(state::countable(value), name + " must be finite and at most 1e30, but is (" + number_text(value.x()) + ", " +
                                       number_text(value.y()) + ", " + number_text(value.z()) + ")");
}

void require_order(const Limits& limits, const std::string& name) {
  require(!std::isnan(limits.low) && !std::isnan(limits.high) && limits.low < HUGE_VAL && limits.high > -HUGE_VAL,
          name + " must be numbers, but are " + number_text(limits.low) + " and " + number_text(limits.high));
  require(limits.low <= limits.high, name + " must be in order, but the low one is " + number_text(limits.low) +
                                         " and the high one " + number_text(limits.high));
  require_amount(limits.hz, "frequency of " + name);
  require_amount(limits.zeta, "damping ratio of " + name);
}

void require_order(const std::optional<Limits>& limits, const std::string& name) {
  if (limits) require_order(*limits, name);
}

void require_motor(const std::optional<Motor>& motor, const std::string& name) {
  if (!motor) return;
  require(state::countable(motor->speed), "speed of " + name + " must be finite, but is " + number_text(motor->speed));
  require(motor->max_force >= 0,
          "greatest force of " + name + " must not be negative, but is " + number_text(motor->max_force));
  if (!motor->position) return;
  require(state::countable(*motor->position),
          "position of " + name + " must be finite, but is " + number_text(*motor->position));
  require(motor->hz > 0 && state::countable(motor->hz),
          "frequency of " + name + " must be positive and finite, but is " + number_text(motor->hz) + " Hz");
  require_amount(motor->zeta, "damping ratio of " + name);
}

void check(const BallJoint&) {}
void check(const FixedJoint&) {}
void check(const HingeJoint& joint) {
  require_order(joint.limits, "limits of a hinge");
  require_motor(joint.motor, "the motor of a hinge");
}
void check(const SliderJoint& joint) {
  require_order(joint.limits, "limits of a slider");
  require_motor(joint.motor, "the motor of a slider");
}
void check(const DistanceJoint& joint) {
  require_order(joint.limits, "limits of a distance");
  require(joint.limits.high >= 0, "a distance cannot be limited to less than 0 m, but its high limit is " +
                                      number_text(joint.limits.high) + " m");
}
void check(const UniversalJoint& joint) {
  require_order(joint.first_limits, "first limits of a universal joint");
  require_order(joint.second_limits, "second limits of a universal joint");
  require_motor(joint.first_motor, "the first motor of a universal joint");
  require_motor(joint.second_motor, "the second motor of a universal joint");
}
void check(const SwingTwistJoint& joint) {
  for (const double swing : {joint.swing_y, joint.swing_z})
    require(swing >= 0 && swing <= half_turn,
            "a swing must lie in 0 to pi (180 degrees), but is " + number_text(swing) + " rad");
  require_order(joint.twist, "limits of a twist");
  require(joint.twist.low >= -half_turn && joint.twist.high <= half_turn,
          "limits of a twist must lie within -pi and pi (180 degrees), but are " + number_text(joint.twist.low) +
              " and " + number_text(joint.twist.high) + " rad");
  require(joint.max_torque >= 0,
          "greatest torque of a joint must not be negative, but is " + number_text(joint.max_torque));
  if (!joint.toward) return;
  const double length = joint.toward->norm();
  require(std::isfinite(length) && length > 0,
          "the rotation that a joint is turned to must be a quaternion that can be normalized");
  require(joint.hz > 0 && state::countable(joint.hz),
          "frequency of a joint must be positive and finite, but is " + number_text(joint.hz) + " Hz");
  require_amount(joint.zeta, "damping ratio of a joint");
}
void check(const WheelJoint& joint) {
  require_amount(joint.hz, "frequency of a suspension");
  require_amount(joint.zeta, "damping ratio of a suspension");
  require_order(joint.suspension, "limits of a suspension");
  require_motor(joint.motor, "the motor of a wheel");
}
void check(const PulleyJoint& joint) {
  require_finite(joint.pulley_a, "place of a pulley");
  require_finite(joint.pulley_b, "place of a pulley");
  require(joint.ratio > 0 && state::countable(joint.ratio),
          "ratio of a pulley must be positive and finite, but is " + number_text(joint.ratio));
  if (joint.length) require_amount(*joint.length, "length of a pulley's rope");
}
void check(const GearJoint& joint) {
  require(joint.ratio != 0 && state::countable(joint.ratio),
          "ratio of a gear must be finite and not 0, but is " + number_text(joint.ratio));
}
void check(const SpringJoint& joint) {
  require_amount(joint.length, "length of a spring");
  require_amount(joint.stiffness, "stiffness of a spring");
  require_amount(joint.damping, "damping of a spring");
}

Pose checked(const Pose& frame) {
  require_finite(frame.position, "place of a joint's frame");
  const double length = frame.rotation.norm();
  require(std::isfinite(length) && length > 0,
          "rotation of a joint's frame must be a quaternion that can be normalized");
  return {frame.position, std::abs(length - 1) > 1e-12 ? normalized(frame.rotation) : frame.rotation};
}

}  // namespace

void validate(const JointKind& kind) {
  std::visit([](const auto& joint) { check(joint); }, kind);
}

JointSettings checked(JointSettings settings) {
  validate(settings.kind);
  settings.frame_a = checked(settings.frame_a);
  settings.frame_b = checked(settings.frame_b);
  require(settings.break_force >= 0,
          "the force that breaks a joint must not be negative, but is " + number_text(settings.break_force) + " N");
  require(settings.break_torque >= 0,
          "the torque that breaks a joint must not be negative, but is " + number_text(settings.break_torque) + " N m");
  if (auto* limb = std::get_if<SwingTwistJoint>(&settings.kind); limb && limb->toward)
    limb->toward = normalized(*limb->toward);
  return settings;
}

}  // namespace tweenfall::joints
