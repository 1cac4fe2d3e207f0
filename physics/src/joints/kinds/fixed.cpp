#include "joints/kinds/kinds.h"

namespace tweenfall::joints {

Coordinates coordinates_of(const FixedJoint&, const state::Joint&, const Placement&) {
  return {};
}

void write_rows(const FixedJoint&, state::Joint&, const Placement& at, JointRows& rows) {
  rows.hold_point(at);
  rows.hold_rotation(at);
}

}  // namespace tweenfall::joints
