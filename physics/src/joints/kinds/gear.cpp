#include "joints/kinds/kinds.h"

namespace tweenfall::joints {

/// The angles are sums of the turns of the bodies: nothing else counts whole turns of bodies that also move.
Coordinates coordinates_of(const GearJoint&, const state::Joint& joint, const Placement& at) {
  Coordinates coordinates;
  coordinates.add(joint.angles[0], {Vec3::Zero(), -at.x_a(), Vec3::Zero(), Vec3::Zero()});
  coordinates.add(joint.angles[1], {Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), at.x_b()});
  return coordinates;
}

void write_rows(const GearJoint& kind, state::Joint& joint, const Placement& at, JointRows& rows) {
  rows.hold({Vec3::Zero(), -kind.ratio * at.x_a(), Vec3::Zero(), at.x_b()},
            kind.ratio * joint.angles[0] + joint.angles[1], 0);
}

}  // namespace tweenfall::joints
