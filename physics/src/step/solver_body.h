#pragma once

#include "state/body.h"

namespace tweenfall::step {

/// Index of a led body that does not exist.
constexpr std::uint32_t not_led = 0xffffffffu;

/// A body while contacts are being solved.
struct SolverBody {
  std::uint32_t index = 0;
  bool movable = false;
  bool impact = false;     ///< meets something in this step: its velocity jumps
  bool touched = false;    ///< an impulse reached it in this step
  bool pressed = false;    ///< an impulse reached it in this sub-step
  bool round = false;      ///< a ball: no contact can rock it
  bool sprung = false;     ///< held by a stiff spring
  bool pulled = false;     ///< by a drive: a soft contact would not hold against it
  bool saturated = false;  ///< its drive is at its limit
  bool stirred = false;    ///< by the rebound of this sub-step
  Vec3 lag{0, 0, 0};       ///< from the velocity at the end of the sub-step to its mean, m/s
  double inverse_mass = 0;
  Mat3 inverse_inertia = Mat3::Zero();
  Vec3 center{0, 0, 0}, start_center{0, 0, 0};
  Quat rotation{1, 0, 0, 0}, start_rotation{1, 0, 0, 0};
  Quat turn{1, 0, 0, 0};           ///< from the start of the step until now
  Quat free_rotation{1, 0, 0, 0};  ///< at the end of the sub-step if nothing touches it
  Vec3 linear{0, 0, 0}, angular{0, 0, 0};
  bool conveys = false;         ///< its surface moves relative to it
  Twist surface;                ///< how its surface moves, at the center of mass, world axes
  std::uint32_t led = not_led;  ///< its index among the led bodies
  Vec3 rebound_turn{0, 0, 0};   ///< how far the rebound of the sub-step turns it, rad
  Vec3 drive_impulse{0, 0, 0}, drive_angular_impulse{0, 0, 0};
};

}  // namespace tweenfall::step
