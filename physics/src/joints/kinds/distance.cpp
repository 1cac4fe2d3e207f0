#include <algorithm>

#include "joints/kinds/kinds.h"

namespace tweenfall::joints {

Coordinates coordinates_of(const DistanceJoint&, const state::Joint&, const Placement& at) {
  Coordinates coordinates;
  const Vec3 gap = at.gap();
  const double length = gap.norm();
  // If both ends are at the same place, any direction leads apart.
  coordinates.add(length, apart(at, length > 0 ? Vec3(gap / length) : at.x_a()));
  return coordinates;
}

void write_rows(const DistanceJoint& kind, state::Joint& joint, const Placement& at, JointRows& rows) {
  const Coordinates length = coordinates_of(kind, joint, at);
  const Vec3& side = length.direction[0].linear_b;
  const double kept = joint.side.dot(side);
  joint.side = side;
  const bool rod = kind.limits.low == kind.limits.high && kind.limits.hz == 0;
  rows.keep_of_next(0, rod ? kept : std::max(0.0, kept));
  rows.keep_of_next(1, std::max(0.0, kept));
  const double bend = rows.bend_of(length.position[0], side, at.gap_rate(), at.gap_bend());
  if (rod) rows.hold(length.direction[0], length.position[0] - kind.limits.low, bend);
  rows.bound(length.direction[0], length.position[0], rod ? nullptr : &kind.limits, bend);
}

}  // namespace tweenfall::joints
