#pragma once

// A polynomial in power basis and its first two derivatives, by Horner's rule.

#include "curve/components.h"

namespace tweenfall::math {

// Only the value, with the same bits as from `evaluate_polynomial`.
template <class V>
inline V polynomial_value(const V* c, int degree, double s) noexcept {
  if (degree == 3) return c[0] + s * (c[1] + s * (c[2] + s * c[3]));
  V value = c[degree];
  for (int i = degree - 1; i >= 0; --i) value = c[i] + s * value;
  return value;
}

// The derivative of c0 + c1 s + c2 s^2 + c3 s^3.
template <class V>
inline V cubic_rate(const V& c1, const V& c2, const V& c3, double s) noexcept {
  const V a = c2 + s * c3;
  return (c1 + s * a) + s * (a + s * c3);
}

template <class V>
struct Polynomial {
  V value, first, second;
};

template <class V>
inline Polynomial<V> evaluate_polynomial(const V* c, int degree, double s) noexcept {
  if (degree == 3) {
    const V cubic_s = s * c[3];
    const V a = c[2] + cubic_s;
    const V b = a + cubic_s;
    const V as = s * a;
    return {c[0] + s * (c[1] + as), (c[1] + as) + s * b, 2 * (b + cubic_s)};
  }
  V value = c[degree], first = spans::zero_rate<V>(), half_second = spans::zero_rate<V>();
  for (int i = degree - 1; i >= 0; --i) {
    half_second = half_second * s + first;
    first = first * s + value;
    value = value * s + c[i];
  }
  return {value, first, 2 * half_second};
}

// Only the value, with the same bits as above.
template <class V>
inline V polynomial_at(const V* c, int degree, double s) noexcept {
  return evaluate_polynomial(c, degree, s).value;
}

// From a polynomial in s to the one in x with s = a + b x, in place.
template <class V>
inline void substitute(V* c, int degree, double a, double b) noexcept {
  if (a != 0)
    for (int i = 0; i < degree; ++i)
      for (int k = degree - 1; k >= i; --k) c[k] = c[k] + a * c[k + 1];
  double power = 1;
  for (int i = 1; i <= degree; ++i) c[i] = (power *= b) * c[i];
}

}  // namespace tweenfall::math
