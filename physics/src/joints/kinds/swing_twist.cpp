#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "joints/kinds/kinds.h"

namespace tweenfall::joints {

namespace {

/// A rotation as a swing after a twist about x: rotation = exp(swing) * twist, with swing.x = 0.
struct Swing {
  Vec3 vector{0, 0, 0};  ///< rad
  Quat rotation{1, 0, 0, 0};
};

Swing swing_of(const Quat& rotation) {
  Quat twist(rotation.w(), rotation.x(), 0, 0);
  const double length = twist.norm();
  // After half a turn over, any twist will do.
  twist = length > 0 ? Quat(twist.w() / length, twist.x() / length, 0, 0) : Quat(1, 0, 0, 0);
  Swing swing;
  swing.rotation = rotation * twist.conjugate();
  swing.vector = log_map(swing.rotation);
  swing.vector.x() = 0;
  return swing;
}

/// The axis in a's frame along which an angular velocity changes a function of the swing with this gradient: it
/// inverts the derivative of the exponential, and is independent of the twist about x as b carries it.
/// Source: Bullo and Murray, Proportional Derivative Control on the Euclidean Group, 1995 (dexp and its inverse).
Vec3 axis_of(const Swing& swing, const Vec3& gradient) {
  const double angle = swing.vector.norm();
  const Vec3 carried = swing.rotation * Vec3(1, 0, 0);
  // The swing's quaternion holds the sine and the cosine of half of its angle.
  const double sin = swing.rotation.vec().norm();
  const double cos = std::abs(swing.rotation.w());
  // half cot(half), and the remainder
  const double cotangent = sin > 0 ? 0.5 * angle * cos / sin : 1;
  const double rest = angle > 1e-4 ? (1 - cotangent) / (angle * angle) : 1.0 / 12;
  // Transpose of the inverse of the left derivative: 1 + [s]/2 + rest [s]^2.
  const auto undone = [&](const Vec3& value) -> Vec3 {
    const Vec3 once = swing.vector.cross(value);
    return value + 0.5 * once + rest * swing.vector.cross(once);
  };
  const Vec3 first = undone(gradient);
  const Vec3 free = undone(Vec3(1, 0, 0));
  const double carry = free.dot(carried);
  return std::abs(carry) > 1e-9 ? Vec3(first - first.dot(carried) / carry * free) : first;
}

/// The axis about which b twists: halfway between both x axes, as long as the twist is fast.
Direction twist_direction(const Placement& at) {
  const Vec3 x_a = at.x_a();
  const Vec3 both = x_a + at.x_b();
  const double sum = 1 + x_a.dot(at.x_b());
  return about(sum > 1e-9 ? Vec3(both / sum) : x_a);
}

/// Rows of the cone: four.
void bound_swing(const SwingTwistJoint& kind, state::Joint& joint, const Placement& at, const Quat& relative,
                 JointRows& rows) {
  const double y = std::max(kind.swing_y, narrowest_swing);
  const double z = std::max(kind.swing_z, narrowest_swing);
  // Half an angle is at most its tangent: most limbs are seen to be well inside without computing the angle.
  const double inside = std::min(y, z) - rows.far();
  const double twist_part = relative.w() * relative.w() + relative.x() * relative.x();
  const double swing_part = relative.y() * relative.y() + relative.z() * relative.z();
  if (inside > 0 && 4 * swing_part < inside * inside * twist_part) return rows.idle(4);
  if (rows.far() == 0) {
    const double across_y = (relative.y() * relative.w() - relative.z() * relative.x()) / y;
    const double across_z = (relative.z() * relative.w() + relative.y() * relative.x()) / z;
    if (4 * (across_y * across_y + across_z * across_z) < twist_part * twist_part) return rows.idle(4);
  }
  const Swing swing = swing_of(relative);
  // The ellipse (s_y / y)^2 + (s_z / z)^2 = 1, and the distance to it to first order.
  const Vec3 scaled(0, swing.vector.y() / y, swing.vector.z() / z);
  const double share = scaled.norm();
  const Vec3 gradient = share > 0 ? Vec3(0, scaled.y() / (share * y), scaled.z() / (share * z)) : Vec3(0, 0, 0);
  const double steepness = gradient.norm();
  if (steepness > 0) {
    const Vec3 side = gradient / steepness;
    // The last impulse belongs to the side on which the limb was then.
    rows.keep_of_next(1, std::max(0.0, joint.side.dot(side)));
    joint.side = side;
    const Limits cone{-std::numeric_limits<double>::infinity(), 1 / steepness, kind.twist.hz, kind.twist.zeta};
    rows.bound(about(at.axes_a * axis_of(swing, side)), share / steepness, &cone);
  } else {
    rows.idle(2);
  }
  // At the ends of a narrow ellipse one row flips from side to side and the limb slips past: two more cut them off.
  const double most = std::max(y, z);
  if (std::min(y, z) < narrow_ellipse * most) {
    const Vec3 longer = Vec3::Unit(y > z ? 1 : 2);
    const Limits ends{-most, most, kind.twist.hz, kind.twist.zeta};
    rows.bound(about(at.axes_a * axis_of(swing, longer)), swing.vector.dot(longer), &ends);
  } else {
    rows.idle(2);
  }
}

/// Rows of the twist: two.
void bound_twist(const SwingTwistJoint& kind, const Placement& at, const Quat& relative, JointRows& rows) {
  const double inside = std::min(kind.twist.high, -kind.twist.low) - rows.far();
  if (inside > 0 && 2 * std::abs(relative.x()) < inside * std::abs(relative.w())) return rows.idle(2);
  rows.bound(twist_direction(at), twist_of(relative), &kind.twist);
}

}  // namespace

Coordinates coordinates_of(const SwingTwistJoint&, const state::Joint&, const Placement& at) {
  Coordinates coordinates;
  const Quat relative = at.relative();
  const Swing swing = swing_of(relative);
  coordinates.add(twist_of(relative), twist_direction(at));
  coordinates.add(swing.vector.y(), about(at.axes_a * axis_of(swing, Vec3(0, 1, 0))));
  coordinates.add(swing.vector.z(), about(at.axes_a * axis_of(swing, Vec3(0, 0, 1))));
  return coordinates;
}

void write_rows(const SwingTwistJoint& kind, state::Joint& joint, const Placement& at, JointRows& rows) {
  rows.hold_point(at);
  const Quat relative = at.relative();
  bound_swing(kind, joint, at, relative, rows);
  bound_twist(kind, at, relative, rows);
  if (kind.toward) {
    // Along b's own axes, which for a limb are nearly those of its inertia, so that the springs hardly affect each
    // other.
    const Vec3 off = log_map(kind.toward->conjugate() * relative);
    for (int i = 0; i < 3; ++i)
      rows.draw(about(at.axes_b * Vec3::Unit(i)), off[i], 0, kind.hz, kind.zeta, kind.max_torque);
  } else {
    rows.idle(3);
  }
}

}  // namespace tweenfall::joints
