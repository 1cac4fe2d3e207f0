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

}  // namespace tweenfall
