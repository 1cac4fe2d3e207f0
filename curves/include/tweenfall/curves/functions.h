#pragma once

/// Motion that a formula gives: state as an exact function of time, beside keyframes.

#include <tweenfall/curves/curve.h>

namespace tweenfall {

/// A body thrown in uniform gravity: from + velocity t + gravity t^2 / 2.
struct Projectile {
  Vec3 from{0, 0, 0};         ///< m
  Vec3 velocity{0, 0, 0};     ///< m/s at t = 0
  Vec3 gravity{0, -9.81, 0};  ///< m/s^2
};
[[nodiscard]] Curve<Vec3> projectile(const Projectile& settings);

/// amplitude cos(2 pi hz t + phase) exp(-damping t).
struct Oscillator {
  double amplitude = 1;  ///< any unit U
  double hz = 1;         ///< cycles per second
  double phase = 0;      ///< radians
  double damping = 0;    ///< decay rate, 1/s; >= 0
  double center = 0;     ///< U, added
};
/// @throws std::invalid_argument for non-finite numbers or negative damping.
[[nodiscard]] Curve<double> oscillator(const Oscillator& settings);

/// A mass on a damped spring whose anchor moves evenly: x'' + 2 z w x' + w^2 (x - goal - goal_velocity t) = 0 with
/// w = 2 pi hz, solved exactly for every damping ratio and at every time, before t = 0 too.
struct DampedSpring {
  double hz = 1;             ///< undamped cycles per second; > 0
  double damping_ratio = 1;  ///< z; 0 rings forever, 1 is critical, above 1 creeps; >= 0
  double position = 0;       ///< any unit U, at t = 0
  double velocity = 0;       ///< U/s, at t = 0
  double goal = 0;           ///< U, at t = 0
  double goal_velocity = 0;  ///< U/s
};
/// @throws std::invalid_argument for non-finite numbers, hz not > 0 or a negative damping ratio.
[[nodiscard]] Curve<double> damped_spring(const DampedSpring& settings);

}  // namespace tweenfall
