#include "joints/kinds/kinds.h"

namespace tweenfall::joints {

Coordinates coordinates_of(const PulleyJoint& kind, const state::Joint&, const Placement& at) {
  Coordinates coordinates;
  const Vec3 rope_a = at.point_a() - kind.pulley_a;
  const Vec3 rope_b = at.point_b() - kind.pulley_b;
  const double length_a = rope_a.norm();
  const double length_b = rope_b.norm();
  const Vec3 away_a = length_a > 0 ? Vec3(rope_a / length_a) : Vec3(0, -1, 0);
  const Vec3 away_b = kind.ratio * (length_b > 0 ? Vec3(rope_b / length_b) : Vec3(0, -1, 0));
  coordinates.add(length_a + kind.ratio * length_b, {-away_a, -at.arm_a.cross(away_a), away_b, at.arm_b.cross(away_b)});
  return coordinates;
}

void write_rows(const PulleyJoint& kind, state::Joint& joint, const Placement& at, JointRows& rows) {
  const Coordinates rope = coordinates_of(kind, joint, at);
  const Limits limits{0, kind.length.value_or(std::numeric_limits<double>::infinity())};
  const auto bend_of = [&rows](const Vec3& way, const Twist& twist, const Vec3& arm) {
    const double length = way.norm();
    if (!(length > 0)) return 0.0;
    return rows.bend_of(length, way / length, velocity_at(twist, arm), Placement::bend(twist, arm));
  };
  const double bend = bend_of(at.point_a() - kind.pulley_a, at.twist_a, at.arm_a) +
                      kind.ratio * bend_of(at.point_b() - kind.pulley_b, at.twist_b, at.arm_b);
  rows.bound(rope.direction[0], rope.position[0], &limits, bend);
}

}  // namespace tweenfall::joints
