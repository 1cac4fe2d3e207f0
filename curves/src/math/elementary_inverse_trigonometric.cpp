#include <tweenfall/curves/elementary.h>

#include <algorithm>
#include <cmath>

#include "math/double_double.h"

namespace tweenfall::elementary {
namespace {

using two_part::Sum;

// atan(i / 8)
constexpr Sum eighths[9] = {
    {0x0.0p+0, 0x0.0p+0},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
};
constexpr Sum half_pi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr Sum pi = {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

Sum negated(const Sum& a) noexcept {
  return {-a.high, -a.low};
}

// Angle of (x, y) for 0 <= y <= x, x > 0: the angle of the nearest eighth of a slope is subtracted, so that a short
// series is left.
Sum octant(const Sum& y, const Sum& x) noexcept {
  const int i = static_cast<int>(std::floor(8 * (y.high / x.high) + 0.5));
  const double c = i / 8.0;
  const Sum cx = two_part::product(c, x.high), cy = two_part::product(c, y.high);
  const Sum numerator = two_part::add(y, {-cx.high, -cx.low - c * x.low});
  const Sum denominator = two_part::add(x, {cy.high, cy.low + c * y.low});
  const Sum t = two_part::divide(numerator, denominator);
  const double z = t.high * t.high;
  const double p = -1.0 / 3 + z * (1.0 / 5 + z * (-1.0 / 7 + z * (1.0 / 9 + z * (-1.0 / 11 + z * (1.0 / 13)))));
  const Sum series = two_part::quick_sum(t.high, t.low + t.high * z * p);
  return two_part::add(eighths[i], series);
}

// Angle of (x, y) anywhere but the origin.
double angle(Sum y, Sum x) noexcept {
  const bool below = std::signbit(y.high), behind = std::signbit(x.high);
  if (below) y = negated(y);
  if (behind) x = negated(x);
  const bool steep = y.high > x.high;
  Sum a = steep ? octant(x, y) : octant(y, x);
  if (steep) a = two_part::add(half_pi, negated(a));
  if (behind) a = two_part::add(pi, negated(a));
  const double result = a.high + a.low;
  return below ? -result : result;
}

Sum square_root(const Sum& a) noexcept {
  if (!(a.high > 0)) return {0, 0};
  const double root = std::sqrt(a.high);
  const Sum p = two_part::product(root, root);
  return two_part::quick_sum(root, ((a.high - p.high) - p.low + a.low) / (2 * root));
}

// sqrt(1 - x^2) without losing digits near |x| = 1.
Sum complement(double x) noexcept {
  const Sum square = two_part::product(x, x);
  return square_root(two_part::add({1, 0}, negated(square)));
}

}  // namespace

double atan2(double y, double x) noexcept {
  if (std::isnan(x) || std::isnan(y)) return x + y;
  if (y == 0) {
    if (x == 0) return 0;
    return x > 0 ? y : std::copysign(pi.high, y);
  }
  if (x == 0) return std::copysign(half_pi.high, y);
  if (std::isinf(x) || std::isinf(y)) {
    const double ax = std::isinf(x) ? 1 : 0, ay = std::isinf(y) ? 1 : 0;
    return atan2(std::copysign(ay, y), std::copysign(ax, x));
  }
  // Away from the ends of the exponent range the split products are exact.
  const double largest = std::max(std::abs(x), std::abs(y));
  if (largest > 0x1p500) {
    x *= 0x1p-600;
    y *= 0x1p-600;
  } else if (largest < 0x1p-400) {
    x *= 0x1p600;
    y *= 0x1p600;
  }
  if (x > 0 && std::abs(y) < 0x1p-60 * x) return y / x;
  return angle({y, 0}, {x, 0});
}

double atan(double x) noexcept {
  return atan2(x, 1);
}

double asin(double x) noexcept {
  const double s = std::clamp(x, -1.0, 1.0);
  if (std::abs(s) < 0x1p-60) return s;
  return angle({s, 0}, complement(s));
}

double acos(double x) noexcept {
  const double c = std::clamp(x, -1.0, 1.0);
  if (c == 1) return 0;
  if (std::abs(c) < 0x1p-60) return half_pi.high;
  return angle(complement(c), {c, 0});
}

}  // namespace tweenfall::elementary
