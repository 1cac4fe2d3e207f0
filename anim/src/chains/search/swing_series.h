#pragma once

// Rotations by a vector, and how they change with it, for plain numbers and for numbers with rates.

#include "chains/search/plain_or_dual.h"

namespace tweenfall::chains {

/// Of an angle u: sin u / u, (1 - cos u) / u^2 and (u - sin u) / u^3, by its square.
template <class Number>
void sines_of(const Number& square, Number (&sines)[3]) noexcept {
  constexpr double small = 0.02;
  if (value_of(square) < small) {
    const Number& s = square;
    sines[0] =
        Number(1) - s * (Number(1.0 / 6) - s * (Number(1.0 / 120) - s * (Number(1.0 / 5040) - s * (1.0 / 362880))));
    sines[1] = Number(0.5) -
               s * (Number(1.0 / 24) - s * (Number(1.0 / 720) - s * (Number(1.0 / 40320) - s * (1.0 / 3628800))));
    sines[2] = Number(1.0 / 6) -
               s * (Number(1.0 / 120) - s * (Number(1.0 / 5040) - s * (Number(1.0 / 362880) - s * (1.0 / 39916800))));
    return;
  }
  const Number angle = root(square);
  const SinCosOf<Number> of = sin_cos_of(angle);
  const Number inverse = reciprocal(angle), inverse_square = reciprocal(square);
  sines[0] = of.sin * inverse;
  sines[1] = (Number(1) - of.cos) * inverse_square;
  sines[2] = (angle - of.sin) * inverse * inverse_square;
}

/// The derivatives of the second and the third by the square.
template <class Number>
void sine_slopes_of(const Number& square, const Number (&sines)[3], Number (&slopes)[2]) noexcept {
  constexpr double small = 0.02;
  if (value_of(square) < small) {
    const Number& s = square;
    slopes[0] = -(Number(1.0 / 24) - s * (Number(2.0 / 720) - s * (Number(3.0 / 40320) - s * (4.0 / 3628800))));
    slopes[1] = -(Number(1.0 / 120) - s * (Number(2.0 / 5040) - s * (Number(3.0 / 362880) - s * (4.0 / 39916800))));
    return;
  }
  const Number half = 0.5 * reciprocal(square);
  slopes[0] = half * (sines[0] - 2.0 * sines[1]);
  slopes[1] = half * (sines[1] - 3.0 * sines[2]);
}

/// The rotation by a vector, from its `sines_of`.
template <class Number>
Nine<Number> turned_about(const Three<Number>& axis, const Number& first, const Number& second) noexcept {
  const auto column = [&](const Three<Number>& a) {
    const Three<Number> once = cross(axis, a);
    return a + first * once + second * cross(axis, once);
  };
  const Nine<Number> still;
  return {column(still.x), column(still.y), column(still.z)};
}

/// The rotation by an angle about a unit axis.
template <class Number>
Nine<Number> turned_about(const Three<Number>& axis, const Number& angle) noexcept {
  const SinCosOf<Number> of = sin_cos_of(angle);
  return turned_about(axis, of.sin, Number(1) - of.cos);
}

}  // namespace tweenfall::chains
