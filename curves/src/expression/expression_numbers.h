#pragma once

// The operators and functions of expressions, each written once for two kinds of numbers: those with their first two
// derivatives, and those that stand still. Some are choices among what is computed in any case, so that a loop over
// many is done several at a time.

#include <tweenfall/curves/elementary.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include "math/elementary_series.h"
#include "math/jet.h"

namespace tweenfall::expressions {

using math::Jet;

/// A number all of whose derivatives are 0.
struct Still {
  double v = 0;
};
constexpr Still operator+(const Still& a, const Still& b) noexcept {
  return {a.v + b.v};
}
constexpr Still operator-(const Still& a, const Still& b) noexcept {
  return {a.v - b.v};
}
constexpr Still operator+(const Still& a, double b) noexcept {
  return {a.v + b};
}
constexpr Still operator*(const Still& a, const Still& b) noexcept {
  return {a.v * b.v};
}
constexpr Still operator*(double a, const Still& b) noexcept {
  return {b.v * a};
}
constexpr Still chained(const Still&, double value, double, double) noexcept {
  return {value};
}
using math::chained;

inline constexpr double none = std::numeric_limits<double>::quiet_NaN();

template <class Number>
TWEENFALL_INLINED Number fixed(double v) noexcept {
  return {v};
}

// Sign that `a` takes just beside this point, on the side given by `way`.
TWEENFALL_INLINED double tendency(const Jet& a, double way) noexcept {
  const double turned = a.d != 0 ? way * a.d : a.dd;
  const double s = a.v != 0 ? a.v : turned;
  return s > 0 ? 1 : s < 0 ? -1 : 0;
}
TWEENFALL_INLINED double tendency(const Still& a, double) noexcept {
  return a.v > 0 ? 1 : a.v < 0 ? -1 : 0;
}

TWEENFALL_INLINED Jet chosen(bool which, const Jet& yes, const Jet& no) noexcept {
  return {which ? yes.v : no.v, which ? yes.d : no.d, which ? yes.dd : no.dd};
}
TWEENFALL_INLINED Still chosen(bool which, const Still& yes, const Still& no) noexcept {
  return {which ? yes.v : no.v};
}

TWEENFALL_INLINED Jet negative(const Jet& a) noexcept {
  return {-a.v, -a.d, -a.dd};
}
TWEENFALL_INLINED Still negative(const Still& a) noexcept {
  return {-a.v};
}

TWEENFALL_INLINED Jet quotient(const Jet& a, const Jet& b) noexcept {
  const double q = a.v / b.v, d = (a.d - q * b.d) / b.v;
  return {q, d, (a.dd - 2 * d * b.d - q * b.dd) / b.v};
}
TWEENFALL_INLINED Still quotient(const Still& a, const Still& b) noexcept {
  return {a.v / b.v};
}

TWEENFALL_INLINED Jet magnitude(const Jet& a, double way) noexcept {
  const double sign = tendency(a, way);
  return {std::abs(a.v), sign * a.d, sign * a.dd};
}
TWEENFALL_INLINED Still magnitude(const Still& a, double) noexcept {
  return {std::abs(a.v)};
}

template <class Number>
TWEENFALL_INLINED Number floor_of(const Number& a, double way) noexcept {
  const double f = std::floor(a.v);
  return fixed<Number>(tendency(a - fixed<Number>(f), way) < 0 ? f - 1 : f);
}

template <class Number>
TWEENFALL_INLINED Number lesser(const Number& a, const Number& b, double way) noexcept {
  return chosen(tendency(b - a, way) < 0, b, a);
}
template <class Number>
TWEENFALL_INLINED Number greater(const Number& a, const Number& b, double way) noexcept {
  return chosen(tendency(b - a, way) > 0, b, a);
}
template <class Number>
TWEENFALL_INLINED Number clamped(const Number& x, const Number& low, const Number& high, double way) noexcept {
  return lesser(greater(x, low, way), high, way);
}

TWEENFALL_INLINED bool is_zero(const Jet& a) noexcept {
  return (a.v == 0) & (a.d == 0) & (a.dd == 0);
}
TWEENFALL_INLINED bool is_zero(const Still& a) noexcept {
  return a.v == 0;
}
TWEENFALL_INLINED Jet square_root(const Jet& a) noexcept {
  const double root = a.v == 0 ? 0 : std::sqrt(a.v);
  const Jet result = chained(a, root, 0.5 / root, -0.25 / (root * a.v));
  return chosen(a.v < 0, fixed<Jet>(none), chosen(is_zero(a), fixed<Jet>(0), result));
}
TWEENFALL_INLINED Still square_root(const Still& a) noexcept {
  const double root = a.v == 0 ? 0 : std::sqrt(a.v);
  return {a.v < 0 ? none : root};
}

template <class Number>
inline Number arc_sine(const Number& a) noexcept {
  if (!(std::abs(a.v) <= 1)) return fixed<Number>(none);
  const double first = 1 / std::sqrt((1 - a.v) * (1 + a.v));
  return chained(a, elementary::asin(a.v), first, a.v * first * first * first);
}

template <class Number>
inline Number arc_tangent(const Number& a) noexcept {
  const double first = 1 / (1 + a.v * a.v);
  return chained(a, elementary::atan(a.v), first, -2 * a.v * first * first);
}

// On the cut the side decides: pi where y comes from above, -pi where it comes from below.
template <class Number>
inline double angle_at(const Number& y, const Number& x, double way) noexcept {
  using std::numbers::pi;
  return y.v == 0 && x.v < 0 ? (tendency(y, way) < 0 ? -pi : pi) : elementary::atan2(y.v, x.v);
}
inline Still angle_of(const Still& y, const Still& x, double way) noexcept {
  return {angle_at(y, x, way)};
}
inline Jet angle_of(const Jet& y, const Jet& x, double way) noexcept {
  const double square = x.v * x.v + y.v * y.v;
  const double turn = x.v * y.d - y.v * x.d, turning = x.v * y.dd - y.v * x.dd;
  const double growth = 2 * (x.v * x.d + y.v * y.d), rate = turn / square;
  return {angle_at(y, x, way), rate, (turning - rate * growth) / square};
}

inline Still cube_root(const Still& a) noexcept {
  return {a.v == 0 ? 0 : elementary::cbrt(a.v)};
}
inline Jet cube_root(const Jet& a) noexcept {
  return math::cbrt(a);
}

inline Jet exponential(const Jet& a) noexcept {
  const double e = elementary::exp(a.v);
  return chained(a, e, e, e);
}
inline Jet logarithm(const Jet& a) noexcept {
  return chained(a, elementary::log(a.v), 1 / a.v, -1 / (a.v * a.v));
}

/// The power is a product of up to 64 numbers, so that t^2 is t*t to the last bit.
[[nodiscard]] inline bool is_product(double exponent) noexcept {
  return exponent == std::floor(exponent) && std::abs(exponent) <= 64;
}
/// x^y for a fixed y.
[[nodiscard]] inline double power_value(double x, double y) noexcept {
  if (is_product(y)) {
    double product = 1, square = x;
    for (int n = static_cast<int>(std::abs(y)); n > 0; n /= 2) {
      if (n % 2 == 1) product *= square;
      square *= square;
    }
    return y < 0 ? 1 / product : product;
  }
  if (x >= 0 || x != x) return elementary::pow(x, y);
  if (y != std::floor(y)) return none;
  const double size = elementary::pow(-x, y);
  return std::fmod(y, 2) == 0 ? size : -size;
}

/// a^n from its value and, for a with derivatives, those of a^(n-1) and a^(n-2).
TWEENFALL_INLINED Jet raised(const Jet& a, double n, double value, double below, double second_below) noexcept {
  const double first = n == 0 ? 0 : n * below;
  const double second = n == 0 || n == 1 ? 0 : n * (n - 1) * second_below;
  const Jet result = chained(a, value, first, second);
  // A constant base has no rates, not even where the power is steep.
  return chosen((a.d == 0) & (a.dd == 0), fixed<Jet>(result.v), result);
}
inline Jet raised(const Jet& a, const Jet& b) noexcept {
  if (b.d == 0 && b.dd == 0) {
    const double n = b.v;
    return raised(a, n, power_value(a.v, n), n == 0 ? 0 : power_value(a.v, n - 1),
                  n == 0 || n == 1 ? 0 : power_value(a.v, n - 2));
  }
  if (!(a.v > 0)) return {a.v == 0 && b.v > 0 ? 0 : none, none, none};
  Jet result = exponential(b * logarithm(a));
  result.v = elementary::pow(a.v, b.v);
  return result;
}

template <class Number>
TWEENFALL_INLINED Number smooth_step(const Number& from, const Number& to, const Number& x, double way) noexcept {
  const Number u = clamped(quotient(x - from, to - from), fixed<Number>(0), fixed<Number>(1), way);
  return u * u * (fixed<Number>(3) - 2 * u);
}

}  // namespace tweenfall::expressions
