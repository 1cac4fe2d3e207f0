#include "joints/kinds/kinds.h"

namespace tweenfall::joints {

Coordinates coordinates_of(const WheelJoint&, const state::Joint& joint, const Placement& at) {
  Coordinates coordinates;
  const Vec3 up = at.y_a();
  coordinates.add(unwrapped(twist_of(at.relative()), joint.angles[0]), about(at.x_a()));
  coordinates.add(up.dot(at.gap()), along(at, up));
  return coordinates;
}

void write_rows(const WheelJoint& kind, state::Joint& joint, const Placement& at, JointRows& rows) {
  for (const Vec3& axis : {at.x_a(), at.z_a()}) rows.hold_across(at, axis);
  for (const Vec3& axis : {at.y_a(), at.z_a()}) rows.hold_square(at, axis, at.x_b());
  const Coordinates own = coordinates_of(kind, joint, at);
  if (kind.hz > 0)
    rows.draw(own.direction[1], own.position[1], 0, kind.hz, kind.zeta, std::numeric_limits<double>::infinity());
  else
    rows.idle();
  rows.bound(own.direction[1], own.position[1], pointer_to(kind.suspension), at.bend_along(at.y_a()));
  rows.drive(own.direction[0], own.position[0], pointer_to(kind.motor));
}

}  // namespace tweenfall::joints
