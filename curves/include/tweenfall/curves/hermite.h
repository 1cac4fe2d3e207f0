#pragma once

/// The cubic Hermite basis: four polynomials that blend two values and two slopes.
///
/// With u from 0 to 1 across a segment of `duration` seconds,
///     value(u) = h00 from + h10 duration rate_from + h01 to + h11 duration rate_to.
/// Each weight comes with its derivatives, so a segment's rate is as exact as its value.

#include <tweenfall/curves/values.h>

namespace tweenfall::hermite {

/// The four weights at one u, in the order from, rate_from, to, rate_to.
struct Basis {
  double h00, h10, h01, h11;
};

/// Weights for the value. Source: first lecture, "Hermite cubic basis"; h00 = 2u^3 - 3u^2 + 1.
[[nodiscard]] constexpr Basis basis(double u) noexcept {
  const double v = 1 - u;
  return {(1 + 2 * u) * v * v, u * v * v, u * u * (3 - 2 * u), -u * u * v};
}

/// First derivatives with respect to u; h00' = 6u(u - 1).
[[nodiscard]] constexpr Basis basis_derivative(double u) noexcept {
  return {6 * u * (u - 1), (3 * u - 1) * (u - 1), 6 * u * (1 - u), u * (3 * u - 2)};
}

/// Second derivatives with respect to u.
[[nodiscard]] constexpr Basis basis_second_derivative(double u) noexcept {
  return {12 * u - 6, 6 * u - 4, 6 - 12 * u, 6 * u - 2};
}

/// Value of a cubic Hermite segment.
///
/// @param from, to            values at the ends, any unit U
/// @param rate_from, rate_to  derivatives at the ends, U/s
/// @param duration            length of the segment, s; > 0
/// @param u                   position in the segment, 0 to 1
/// @return value in U, rate in U/s and acceleration in U/s^2; `from` at 0 and `to` at 1, exactly.
template <class T>
[[nodiscard]] Sample<T> sample(const T& from, const T& rate_from, const T& to, const T& rate_to, double duration,
                               double u) noexcept {
  const Basis b = basis(u), d = basis_derivative(u), s = basis_second_derivative(u);
  const double inverse = 1 / duration;
  const T value = b.h00 * from + (b.h10 * duration) * rate_from + b.h01 * to + (b.h11 * duration) * rate_to;
  const T rate = (d.h00 * inverse) * from + d.h10 * rate_from + (d.h01 * inverse) * to + d.h11 * rate_to;
  const T acceleration = (s.h00 * inverse * inverse) * from + (s.h10 * inverse) * rate_from +
                         (s.h01 * inverse * inverse) * to + (s.h11 * inverse) * rate_to;
  return {value, rate, acceleration};
}

}  // namespace tweenfall::hermite
