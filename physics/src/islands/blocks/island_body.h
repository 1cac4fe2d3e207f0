#pragma once

#include <tweenfall/curves/rotation.h>

#include "forces/free_flight.h"
#include "islands/blocks/contact_block.h"
#include "step/solver_body.h"

namespace tweenfall::blocks {

[[nodiscard]] inline Vec3 linear_of(const BodyLanes& body) {
  return {body.linear[0], body.linear[1], body.linear[2]};
}
[[nodiscard]] inline Vec3 angular_of(const BodyLanes& body) {
  return {body.angular[0], body.angular[1], body.angular[2]};
}
[[nodiscard]] inline Vec3 lane_of(const Lanes3& lanes, int lane) {
  return {lanes.x[lane], lanes.y[lane], lanes.z[lane]};
}
inline void add(double (&lanes)[4], const Vec3& value) {
  for (int i = 0; i < 3; ++i) lanes[i] += value[i];
}
inline void set(double (&lanes)[4], const Vec3& value) {
  for (int i = 0; i < 3; ++i) lanes[i] = value[i];
}

/// A lane may get more rows than its own contact needs, because another lane's contact does. They add nothing, but may
/// turn -0 into 0: which contacts share a block must not show in the result.
[[nodiscard]] inline Vec3 without_sign_of_zero(const Vec3& value) {
  return {value.x() + 0.0, value.y() + 0.0, value.z() + 0.0};
}

/// What every sub-step needs of a body of an island; for most bodies it needs nothing else.
struct alignas(64) BodyPace {
  double acceleration[4] = {};  ///< mean of the step, free of contacts: x, y, z and nothing
  double mass = 0;              ///< kg
  double moment = 0;            ///< of a body with `even`, kg m^2
  bool movable = false;
  bool even = false;      ///< the same moment about every axis, and no torque: only contacts change its spin
  bool slender = false;   ///< see state::Makeup
  bool steady = false;    ///< even, and no drag: only the acceleration and contacts change its velocity
  bool unturned = false;  ///< a steady ball: its rotation is computed after the step
  bool impact = false;    ///< meets something in this step: its velocity jumps
  bool touched = false;   ///< an impulse reached it in this step
  bool pressed = false;   ///< an impulse reached it in this sub-step
};

/// How far a body has turned.
struct alignas(32) BodyTurn {
  double turned = 0;      ///< since its rows were prepared, rad
  double latest[3] = {};  ///< rotation vector of a steady body that its rotation does not include yet

  /// Adds a turn that follows, by the first terms of the series of Baker, Campbell and Hausdorff: right to a rounding
  /// where neither is longer than `short_turn`.
  void follow_by(const Vec3& turn) {
    const Vec3 before(latest[0], latest[1], latest[2]);
    const Vec3 bend = turn.cross(before);
    const Vec3 sum = before + turn + 0.5 * bend + (turn - before).cross(bend) / 12;
    for (int k = 0; k < 3; ++k) latest[k] = sum[k];
  }
  /// Whether the next turn could make the sum too long.
  [[nodiscard]] bool far() const {
    return latest[0] * latest[0] + latest[1] * latest[1] + latest[2] * latest[2] > short_turn * short_turn;
  }
  static constexpr double short_turn = 1e-3;  ///< rad
  [[nodiscard]] Quat after(const Quat& rotation) const {
    const Vec3 turn(latest[0], latest[1], latest[2]);
    if (turn == Vec3::Zero()) return rotation;
    Quat now = exp_map(turn) * rotation;
    now.normalize();
    return now;
  }
};

/// How a body had turned since the start of the step when its rows were prepared.
struct alignas(32) TurnOfRows {
  double rotation[4] = {0, 0, 0, 1};  ///< quaternion x, y, z, w
  double angle[4] = {};               ///< sum of the turns, rad: x, y, z and nothing

  [[nodiscard]] Quat quaternion() const { return {rotation[3], rotation[0], rotation[1], rotation[2]}; }
};

/// A body of an island while its contacts are being solved; its velocity is kept apart.
struct alignas(64) IslandBody {
  std::uint32_t index = 0;
  bool movable = false;
  bool isotropic = true;   ///< the same moment about every axis, or none
  bool followed = false;   ///< nothing pressed it in the sub-step before: its spin is followed exactly
  bool round = false;      ///< a ball: no contact can rock it, and none sees it turn
  bool stale = false;      ///< has turned since its rows were prepared
  bool jointed = false;    ///< a joint holds it
  bool held = false;       ///< a drive or a stiff spring holds it
  bool pulled = false;     ///< by a drive without a limit: a soft contact would not hold against it
  bool saturated = false;  ///< its drive is at its limit
  bool conveys = false;    ///< its surface moves relative to it
  Twist surface;           ///< how its surface moves, at the center of mass, world axes
  double given = 1;        ///< share of an impulse that such a drive lets through
  double drag = 0;         ///< 1/s, taken implicitly
  double inverse_mass = 0;
  double inverse_moment = 0;            ///< of an isotropic body
  Mat3 inverse_inertia = Mat3::Zero();  ///< world axes, when its rows were prepared
  Vec3 center{0, 0, 0};                 ///< of a steady body: at the start of the step, until its end
  Quat rotation{1, 0, 0, 0}, start_rotation{1, 0, 0, 0};
  TurnOfRows turn;
  Quat free_rotation{1, 0, 0, 0};     ///< at the end of the sub-step if nothing touches it
  std::uint32_t led = step::not_led;  ///< its index among the led bodies

  // At the start of the sub-step
  Vec3 sub_step_center{0, 0, 0};
  Quat sub_step_rotation{1, 0, 0, 0};
};

}  // namespace tweenfall::blocks
