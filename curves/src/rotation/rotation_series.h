#pragma once

// Scalar functions of the angle that stand in the Jacobian of the exponential and its rate.

namespace tweenfall {

/// With x = |r|^2 and t = |r|: a = (1 - cos t)/t^2, b = (t - sin t)/t^3, and a1, b1 their derivatives
/// with respect to t divided by t (so that a' = a1 (r . r')).
struct RotationSeries {
  double a, b, a1, b1;
  explicit RotationSeries(double square) noexcept;
};

/// Below this square of an angle the functions are taken from their Taylor series in it.
inline constexpr double series_limit = 0.5;

/// a and b of `RotationSeries` alone, for x < series_limit; the next terms are below 1e-17.
[[nodiscard]] inline double series_a(double x) noexcept {
  return 0.5 - x * (1.0 / 24 -
                    x * (1.0 / 720 -
                         x * (1.0 / 40320 - x * (1.0 / 3628800 - x * (1.0 / 479001600 - x * (1.0 / 87178291200.0))))));
}
[[nodiscard]] inline double series_b(double x) noexcept {
  return 1.0 / 6 -
         x * (1.0 / 120 -
              x * (1.0 / 5040 -
                   x * (1.0 / 362880 - x * (1.0 / 39916800 - x * (1.0 / 6227020800.0 - x * (1.0 / 1307674368000.0))))));
}

/// (1/x)(1 - (t/2) cot(t/2)): the factor of the squared cross matrix in the inverse Jacobian, x = t^2.
[[nodiscard]] double inverse_jacobian_coefficient(double square) noexcept;

}  // namespace tweenfall
