#include "joints/kinds/kinds.h"

namespace tweenfall::joints {

Coordinates coordinates_of(const SliderJoint&, const state::Joint&, const Placement& at) {
  Coordinates coordinates;
  const Vec3 axis = at.x_a();
  coordinates.add(axis.dot(at.gap()), along(at, axis));
  return coordinates;
}

void write_rows(const SliderJoint& kind, state::Joint& joint, const Placement& at, JointRows& rows) {
  for (const Vec3& axis : {at.y_a(), at.z_a()}) rows.hold_across(at, axis);
  rows.hold_rotation(at);
  const Coordinates way = coordinates_of(kind, joint, at);
  const Allowed allowed =
      rows.bound(way.direction[0], way.position[0], pointer_to(kind.limits), at.bend_along(at.x_a()));
  rows.drive(way.direction[0], way.position[0], pointer_to(kind.motor), allowed);
}

}  // namespace tweenfall::joints
