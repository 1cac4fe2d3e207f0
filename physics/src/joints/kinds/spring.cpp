#include "joints/kinds/kinds.h"

namespace tweenfall::joints {

Coordinates coordinates_of(const SpringJoint&, const state::Joint& joint, const Placement& at) {
  return coordinates_of(DistanceJoint{}, joint, at);
}

void write_rows(const SpringJoint& kind, state::Joint& joint, const Placement& at, JointRows& rows) {
  const Coordinates length = coordinates_of(kind, joint, at);
  // The impulse keeps its direction while its line turns.
  const Vec3& side = length.direction[0].linear_b;
  rows.keep_of_next(0, joint.side.dot(side));
  joint.side = side;
  rows.spring(length.direction[0], at, length.position[0] - kind.length, side.dot(at.gap_rate()), kind.stiffness,
              kind.damping);
}

}  // namespace tweenfall::joints
