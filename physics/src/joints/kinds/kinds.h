#pragma once

/// What each kind of joint holds, bounds and drives, one file for each.

#include "joints/joint_rows.h"

namespace tweenfall::joints {

/// Positions of a joint's coordinates, and how each is moved.
struct Coordinates {
  int count = 0;
  std::array<double, 3> position{};
  std::array<Direction, 3> direction{};

  void add(double where, const Direction& how) {
    position[static_cast<std::size_t>(count)] = where;
    direction[static_cast<std::size_t>(count++)] = how;
  }
};

/// Coordinates of a joint whose frames lie so.
[[nodiscard]] Coordinates coordinates_of(const BallJoint& kind, const state::Joint& joint, const Placement& at);
[[nodiscard]] Coordinates coordinates_of(const HingeJoint& kind, const state::Joint& joint, const Placement& at);
[[nodiscard]] Coordinates coordinates_of(const SliderJoint& kind, const state::Joint& joint, const Placement& at);
[[nodiscard]] Coordinates coordinates_of(const FixedJoint& kind, const state::Joint& joint, const Placement& at);
[[nodiscard]] Coordinates coordinates_of(const DistanceJoint& kind, const state::Joint& joint, const Placement& at);
[[nodiscard]] Coordinates coordinates_of(const UniversalJoint& kind, const state::Joint& joint, const Placement& at);
[[nodiscard]] Coordinates coordinates_of(const SwingTwistJoint& kind, const state::Joint& joint, const Placement& at);
[[nodiscard]] Coordinates coordinates_of(const WheelJoint& kind, const state::Joint& joint, const Placement& at);
[[nodiscard]] Coordinates coordinates_of(const PulleyJoint& kind, const state::Joint& joint, const Placement& at);
[[nodiscard]] Coordinates coordinates_of(const GearJoint& kind, const state::Joint& joint, const Placement& at);
[[nodiscard]] Coordinates coordinates_of(const SpringJoint& kind, const state::Joint& joint, const Placement& at);

[[nodiscard]] Coordinates coordinates_of(const state::Joint& joint, const Placement& at);

/// Writes the rows of a sub-step; always as many for one kind, in the same order. Notes in the joint what the next
/// sub-step must know of this one.
void write_rows(const BallJoint& kind, state::Joint& joint, const Placement& at, JointRows& rows);
void write_rows(const HingeJoint& kind, state::Joint& joint, const Placement& at, JointRows& rows);
void write_rows(const SliderJoint& kind, state::Joint& joint, const Placement& at, JointRows& rows);
void write_rows(const FixedJoint& kind, state::Joint& joint, const Placement& at, JointRows& rows);
void write_rows(const DistanceJoint& kind, state::Joint& joint, const Placement& at, JointRows& rows);
void write_rows(const UniversalJoint& kind, state::Joint& joint, const Placement& at, JointRows& rows);
void write_rows(const SwingTwistJoint& kind, state::Joint& joint, const Placement& at, JointRows& rows);
void write_rows(const WheelJoint& kind, state::Joint& joint, const Placement& at, JointRows& rows);
void write_rows(const PulleyJoint& kind, state::Joint& joint, const Placement& at, JointRows& rows);
void write_rows(const GearJoint& kind, state::Joint& joint, const Placement& at, JointRows& rows);
void write_rows(const SpringJoint& kind, state::Joint& joint, const Placement& at, JointRows& rows);

/// A cone narrower than this is a hinge's business, rad.
constexpr double narrowest_swing = 1e-3;
/// Shares of the longer axis of an ellipse: with less, its ends are sharp, and blunted.
constexpr double narrow_ellipse = 0.5;
/// Rows of a `SwingTwistJoint`, after those of its point; each beside the one of the lower bound.
constexpr std::uint8_t row_of_cone = 4, row_of_end = 5, row_of_twist = 7;

/// An angle within -pi to pi as the one nearest to the last, whole turns included.
[[nodiscard]] double unwrapped(double angle, double last);
/// How far a rotation turns about the x axis: its twist, rad.
[[nodiscard]] double twist_of(const Quat& rotation);

template <class Value>
[[nodiscard]] const Value* pointer_to(const std::optional<Value>& value) {
  return value ? &*value : nullptr;
}

}  // namespace tweenfall::joints
