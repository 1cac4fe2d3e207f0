#pragma once

// A number with its first and second derivative; conversions are written with it, so that their rates are exact.

#include <tweenfall/curves/elementary.h>

#include <cmath>

namespace tweenfall::math {

struct Jet {
  double v = 0, d = 0, dd = 0;
};

constexpr Jet constant(double v) noexcept {
  return {v, 0, 0};
}
constexpr Jet operator+(const Jet& a, const Jet& b) noexcept {
  return {a.v + b.v, a.d + b.d, a.dd + b.dd};
}
constexpr Jet operator-(const Jet& a, const Jet& b) noexcept {
  return {a.v - b.v, a.d - b.d, a.dd - b.dd};
}
constexpr Jet operator+(const Jet& a, double b) noexcept {
  return {a.v + b, a.d, a.dd};
}
constexpr Jet operator*(const Jet& a, double b) noexcept {
  return {a.v * b, a.d * b, a.dd * b};
}
constexpr Jet operator*(double a, const Jet& b) noexcept {
  return b * a;
}
constexpr Jet operator*(const Jet& a, const Jet& b) noexcept {
  return {a.v * b.v, a.d * b.v + a.v * b.d, a.dd * b.v + 2 * a.d * b.d + a.v * b.dd};
}

/// f(a), from the value and two derivatives of f at a.v.
constexpr Jet chained(const Jet& a, double value, double first, double second) noexcept {
  return {value, first * a.d, second * a.d * a.d + first * a.dd};
}

inline Jet reciprocal(const Jet& a) noexcept {
  const double i = 1 / a.v;
  return chained(a, i, -i * i, 2 * i * i * i);
}

/// Cube root, odd; at zero the slope, which is infinite, is returned as 0.
inline Jet cbrt(const Jet& a) noexcept {
  if (a.v == 0) return {};
  const double root = elementary::cbrt(a.v), first = root / (3 * a.v);
  return chained(a, root, first, -2 * first / (3 * a.v));
}

inline Jet pow(const Jet& a, double exponent) noexcept {
  const double p = elementary::pow(a.v, exponent), first = exponent * p / a.v;
  return chained(a, p, first, (exponent - 1) * first / a.v);
}

}  // namespace tweenfall::math
