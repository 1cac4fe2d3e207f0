#include "joints/kinds.h"

namespace tweenfall::joints {

Coordinates coordinates_of(const SpringJoint&, const state::Joint& joint, const Placement& at) {
  return coordinates_of(DistanceJoint{}, joint, at);
}

void write_rows(const SpringJoint& kind, const state::Joint& joint, const Placement& at, JointRows& rows) {
  const Coordinates length = coordinates_of(kind, joint, at);
  rows.spring(length.direction[0], length.position[0] - kind.length, kind.stiffness, kind.damping);
}

}  // namespace tweenfall::joints
