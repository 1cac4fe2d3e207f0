#pragma once

// Zeros of polynomials on an interval, found between the zeros of their derivatives.

#include <vector>

namespace tweenfall::math {

/// All s in [low, high] with sum c[i] s^i = 0, in order; a touching zero once. None for the zero polynomial.
[[nodiscard]] std::vector<double> polynomial_roots(const std::vector<double>& c, double low, double high);

[[nodiscard]] double polynomial_value(const std::vector<double>& c, double s) noexcept;
[[nodiscard]] std::vector<double> polynomial_derivative(const std::vector<double>& c);

}  // namespace tweenfall::math
