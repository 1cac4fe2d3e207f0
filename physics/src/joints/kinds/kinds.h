#pragma once

/// What each kind of joint holds, bounds and drives, one file per kind.

#include "joints/joint_rows.h"

namespace tweenfall::joints {

/// Positions of a joint's coordinates, and the direction in which each moves.
struct Coordinates {
  int count = 0;
  std::array<double, 3> position{};
  std::array<Direction, 3> direction{};

  void add(double where, const Direction& how) {
    position[static_cast<std::size_t>(count)] = where;
    direction[static_cast<std::size_t>(count++)] = how;
  }
};

/// Coordinates of a joint with this placement.
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

/// Writes the rows of a sub-step; for one kind always the same number, in the same order. Stores in the joint what the
/// next sub-step must know of this one.
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

/// A cone narrower than this should be a hinge, rad.
constexpr double narrowest_swing = 1e-3;
/// Ratio of an ellipse's axes below which its ends are too sharp, and are cut off.
constexpr double narrow_ellipse = 0.5;
/// Rows of a `SwingTwistJoint`, after those of its point. Bounds are pairs, the lower first; the cone is an upper one.
constexpr std::uint8_t row_of_cone = 4, row_of_end = 5, row_of_twist = 7;

/// Whether a motor or a spring of it may give energy to the bodies that a joint holds.
[[nodiscard]] bool gives_energy(const JointKind& kind);

/// The value of an angle within -pi to pi that is nearest to the last one, whole turns included.
[[nodiscard]] double unwrapped(double angle, double last);
/// How far a rotation turns about the x axis: its twist, rad.
[[nodiscard]] double twist_of(const Quat& rotation);

template <class Value>
[[nodiscard]] const Value* pointer_to(const std::optional<Value>& value) {
  return value ? &*value : nullptr;
}

}  // namespace tweenfall::joints
