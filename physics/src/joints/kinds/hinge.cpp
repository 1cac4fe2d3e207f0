#include "joints/kinds/kinds.h"

namespace tweenfall::joints {

Coordinates coordinates_of(const HingeJoint&, const state::Joint& joint, const Placement& at) {
  Coordinates coordinates;
  coordinates.add(unwrapped(twist_of(at.relative()), joint.angles[0]), about(at.x_a()));
  return coordinates;
}

void write_rows(const HingeJoint& kind, state::Joint& joint, const Placement& at, JointRows& rows) {
  rows.hold_point(at);
  rows.hold_square(at, at.y_a(), at.x_b());
  rows.hold_square(at, at.z_a(), at.x_b());
  const Coordinates angle = coordinates_of(kind, joint, at);
  const Allowed allowed = rows.bound(angle.direction[0], angle.position[0], pointer_to(kind.limits));
  rows.drive(angle.direction[0], angle.position[0], pointer_to(kind.motor), allowed);
}

}  // namespace tweenfall::joints
