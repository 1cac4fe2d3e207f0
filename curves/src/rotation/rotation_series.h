#pragma once

// Scalar functions of the angle that stand in the Jacobian of the exponential and its rate.

namespace tweenfall {

/// With x = |r|^2 and t = |r|: a = (1 - cos t)/t^2, b = (t - sin t)/t^3, and a1, b1 their derivatives
/// with respect to t divided by t (so that a' = a1 (r . r')).
struct RotationSeries {
  double a, b, a1, b1;
  explicit RotationSeries(double square) noexcept;
};

/// (1/x)(1 - (t/2) cot(t/2)): the factor of the squared cross matrix in the inverse Jacobian, x = t^2.
[[nodiscard]] double inverse_jacobian_coefficient(double square) noexcept;

}  // namespace tweenfall
