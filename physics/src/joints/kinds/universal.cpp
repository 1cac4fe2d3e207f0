#include <tweenfall/curves/elementary.h>

#include "joints/kinds/kinds.h"

namespace tweenfall::joints {

/// With a cross piece between the bodies: a's frame turns about its x axis by the first angle, then about b's y axis by
/// the second.
Coordinates coordinates_of(const UniversalJoint&, const state::Joint& joint, const Placement& at) {
  Coordinates coordinates;
  const Vec3 x = at.x_a();
  const Vec3 y = at.y_b();
  const Vec3 cross = x.cross(y);
  const double first = elementary::atan2(y.dot(at.z_a()), y.dot(at.y_a()));
  const double second = elementary::atan2(at.x_b().dot(-cross), at.x_b().dot(x));
  coordinates.add(unwrapped(first, joint.angles[0]), about(x));
  coordinates.add(unwrapped(second, joint.angles[1]), about(y));
  return coordinates;
}

void write_rows(const UniversalJoint& kind, state::Joint& joint, const Placement& at, JointRows& rows) {
  rows.hold_point(at);
  rows.hold_square(at, at.x_a(), at.y_b());
  const Coordinates angles = coordinates_of(kind, joint, at);
  const Allowed first = rows.bound(angles.direction[0], angles.position[0], pointer_to(kind.first_limits));
  rows.drive(angles.direction[0], angles.position[0], pointer_to(kind.first_motor), first);
  const Allowed second = rows.bound(angles.direction[1], angles.position[1], pointer_to(kind.second_limits));
  rows.drive(angles.direction[1], angles.position[1], pointer_to(kind.second_motor), second);
}

}  // namespace tweenfall::joints
