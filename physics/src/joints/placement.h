#pragma once

#include "state/body.h"
#include "state/joint.h"

namespace tweenfall::joints {

/// The two frames of a joint in the world, and where their bodies' centers of mass are.
struct Placement {
  Vec3 center_a{0, 0, 0}, center_b{0, 0, 0};
  Vec3 arm_a{0, 0, 0}, arm_b{0, 0, 0};  ///< from the centers to the frames' origins
  Quat axes_a{1, 0, 0, 0}, axes_b{1, 0, 0, 0};
  Twist twist_a, twist_b;  ///< of the bodies at their centers

  [[nodiscard]] Vec3 point_a() const { return center_a + arm_a; }
  [[nodiscard]] Vec3 point_b() const { return center_b + arm_b; }
  /// From a's frame to b's.
  [[nodiscard]] Vec3 gap() const { return (center_b - center_a) + (arm_b - arm_a); }
  [[nodiscard]] Vec3 x_a() const { return axes_a * Vec3(1, 0, 0); }
  [[nodiscard]] Vec3 y_a() const { return axes_a * Vec3(0, 1, 0); }
  [[nodiscard]] Vec3 z_a() const { return axes_a * Vec3(0, 0, 1); }
  [[nodiscard]] Vec3 x_b() const { return axes_b * Vec3(1, 0, 0); }
  [[nodiscard]] Vec3 y_b() const { return axes_b * Vec3(0, 1, 0); }
  [[nodiscard]] Vec3 gap_rate() const { return velocity_at(twist_b, arm_b) - velocity_at(twist_a, arm_a); }
  /// Acceleration of the gap if both bodies keep their velocities.
  [[nodiscard]] Vec3 gap_bend() const { return bend(twist_b, arm_b) - bend(twist_a, arm_a); }
  /// The same along an axis that is fixed to a.
  [[nodiscard]] double bend_along(const Vec3& axis) const {
    const Vec3& spin = twist_a.angular;
    return axis.dot(gap_bend()) + 2 * spin.cross(axis).dot(gap_rate()) + spin.cross(spin.cross(axis)).dot(gap());
  }
  /// Centripetal acceleration of a point carried around.
  [[nodiscard]] static Vec3 bend(const Twist& twist, const Vec3& arm) {
    return twist.angular.cross(twist.angular.cross(arm));
  }
  /// The rotation of b's frame in a's.
  [[nodiscard]] Quat relative() const { return axes_a.conjugate() * axes_b; }
};

/// @param center_a, rotation_a  of a's center of mass and node; for the world: zero and the identity
/// @param mass_center_a  a's center of mass on its node
[[nodiscard]] Placement placement_of(const JointSettings& joint, const Vec3& center_a, const Quat& rotation_a,
                                     const Vec3& mass_center_a, const Vec3& center_b, const Quat& rotation_b,
                                     const Vec3& mass_center_b);
/// For a joint between bodies in their present poses.
[[nodiscard]] Placement placement_in(const state::Joint& joint, const std::vector<state::Body>& bodies);

}  // namespace tweenfall::joints
