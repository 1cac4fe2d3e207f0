#pragma once

/// How an offset decays: the transition from where a body is to where its curve wants it.
///
/// After physics hands a body back, or at a cut between two clips, the difference in position and velocity is kept as
/// an offset that starts with exactly that value and rate and decays. Added to the curve, the result is continuous in
/// both.

#include <tweenfall/curves/values.h>

namespace tweenfall {

/// Quintic that takes an offset and its rate to rest: value, rate and acceleration are all 0 at the end.
/// Source: Bollo, "Inertialization", GDC 2018: duration shortened to -5 x0/v0 where the offset is
/// already heading for zero, start acceleration max(0, (-8 v0 T - 20 x0)/T^2), so it never overshoots.
struct QuinticDecay {
  double coefficients[6]{};  ///< power basis in seconds
  double duration = 0;       ///< s actually used; 0 for no offset

  /// @param offset, rate  any unit U, U/s, either sign
  /// @param blend_time    s; > 0
  /// @param floor         least duration, s (default: 0.02); shortening never goes below it
  /// @param acceleration  U/s^2 (default: 4000); the duration is not shortened where the start acceleration, at most
  ///                      8 |rate| / duration, would exceed it
  ///
  /// Without the last bound, a tiny offset would be met with an arbitrarily large acceleration.
  QuinticDecay() = default;
  QuinticDecay(double offset, double rate, double blend_time, double floor = 0.02, double acceleration = 4000);

  [[nodiscard]] Sample<double> sample(double seconds) const noexcept;  ///< 0 from `duration` on, exactly
};

/// Critically damped spring: (x0 + (v0 + y x0) t) exp(-y t), y = 2 ln 2 / half_life. What already decays at the rate y
/// halves every half of a half-life; from rest, .597 is left after one half-life, half after 1.21, .237 after two.
/// Source of the name: Holden, "Spring-It-On", 2021.
struct SpringDecay {
  double offset = 0, rate = 0;  ///< U, U/s
  double half_life = 0.1;       ///< s; > 0

  [[nodiscard]] Sample<double> sample(double seconds) const noexcept;
};

}  // namespace tweenfall
