#include "joints/kinds/kinds.h"

namespace tweenfall::joints {

Coordinates coordinates_of(const BallJoint&, const state::Joint&, const Placement&) {
  return {};
}

void write_rows(const BallJoint&, state::Joint&, const Placement& at, JointRows& rows) {
  rows.hold_point(at);
}

}  // namespace tweenfall::joints
