#pragma once

// Scalar functions of the angle that occur in the Jacobian of the exponential and its rate.

namespace tweenfall::rotations {

/// With x = |r|^2 and t = |r|: a = (1 - cos t)/t^2, b = (t - sin t)/t^3, and a1, b1 their derivatives
/// with respect to t divided by t (so that a' = a1 (r . r')).
struct RotationSeries {
  double a, b, a1, b1;
  explicit RotationSeries(double square) noexcept;
};

/// For squares of angles below this, the functions are computed from their Taylor series in the square.
inline constexpr double series_limit = 0.5;

/// With x = |r|^2 and t = |r|: cos(t/2), and sin(t/2)/t, the factor from a rotation vector to its quaternion.
struct HalfTurn {
  double cosine, sine_share;
};

/// For x < series_limit, by Taylor series in (t/2)^2; the next terms are below 1e-17. Even and odd terms are summed
/// side by side, which takes half the time.
[[nodiscard]] inline HalfTurn half_turn(double x) noexcept {
  const double h = x / 4, hh = h * h;
  const double cosine_even = 1.0 / 24 + hh * (1.0 / 40320 + hh * (1.0 / 479001600));
  const double cosine_odd = 1.0 / 720 + hh * (1.0 / 3628800 + hh * (1.0 / 87178291200.0));
  const double sine_even = 1.0 / 120 + hh * (1.0 / 362880 + hh * (1.0 / 6227020800.0));
  const double sine_odd = 1.0 / 5040 + hh * (1.0 / 39916800);
  return {1 - (0.5 * h - hh * (cosine_even - h * cosine_odd)),
          0.5 - 0.5 * (1.0 / 6 * h - hh * (sine_even - h * sine_odd))};
}

/// a and b of `RotationSeries` alone, for x < series_limit; the next terms of b are below 1e-17.
[[nodiscard]] inline double series_a(double x) noexcept {
  const double share = half_turn(x).sine_share;
  return 2 * share * share;  // (1 - cos t)/t^2 = 2 sin^2(t/2)/t^2
}
[[nodiscard]] inline double series_b(double x) noexcept {
  return 1.0 / 6 -
         x * (1.0 / 120 -
              x * (1.0 / 5040 -
                   x * (1.0 / 362880 - x * (1.0 / 39916800 - x * (1.0 / 6227020800.0 - x * (1.0 / 1307674368000.0))))));
}

/// (1/x)(1 - (t/2) cot(t/2)): the factor of the squared cross matrix in the inverse Jacobian, x = t^2.
[[nodiscard]] double inverse_jacobian_coefficient(double square) noexcept;

}  // namespace tweenfall::rotations
