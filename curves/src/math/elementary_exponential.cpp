#include <tweenfall/curves/elementary.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "math/elementary_series.h"

namespace tweenfall::elementary {
namespace {

using namespace series;

constexpr double infinity = std::numeric_limits<double>::infinity();

double scaled(double value, int exponent) noexcept {
  if (exponent < -1021 || exponent > 1023) return std::ldexp(value, exponent);
  return value * std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

// exp(x.high + x.low) for |x| up to 746, also where it has lost digits.
double any_exp_of(const Sum& x) noexcept {
  const double k = powers_of_two_in(x.high);
  return scaled(exp_less_powers(x, k), static_cast<int>(k));
}

Sum any_log_of(double x) noexcept {
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0x1.6a09e667f3bcdp-1) {
    m *= 2;
    --exponent;
  }
  return log_of(m, exponent);
}

}  // namespace

double exp(double x) noexcept {
  if (x != x) return x;
  if (x > 709.8) return infinity;
  if (x < -745.2) return 0;
  return any_exp_of({x, 0});
}

double log(double x) noexcept {
  if (x == 0) return -infinity;
  if (!(x > 0)) return std::numeric_limits<double>::quiet_NaN();
  if (x == infinity) return x;
  const Sum l = any_log_of(x);
  return l.high + l.low;
}

double pow(double x, double y) noexcept {
  if (y == 0 || x == 1) return 1;
  if (x != x || y != y) return x + y;
  if (x == 0) return y > 0 ? 0 : infinity;
  if (x < 0) return std::numeric_limits<double>::quiet_NaN();
  if (y == 1) return x;
  if (x == infinity) return y > 0 ? infinity : 0;
  if (std::isinf(y)) return (x > 1) == (y > 0) ? infinity : 0;
  const Sum l = any_log_of(x);
  const double rough = y * l.high;
  if (rough > 709.8) return infinity;
  if (rough < -745.2) return 0;
  if (std::abs(rough) < 0x1p-60) return 1;
  // A y too large for the split product only matters where x is close to 1.
  const double scale = std::abs(y) > 0x1p900 ? 0x1p-200 : 1;
  const Sum p = two_part::product(y * scale, l.high / scale);
  return any_exp_of(two_part::quick_sum(p.high, p.low + y * l.low));
}

double cbrt(double x) noexcept {
  if (x == 0 || x != x || std::isinf(x)) return x;
  int exponent = 0;
  double m = std::frexp(std::abs(x), &exponent);
  const int rest = ((exponent % 3) + 3) % 3;
  m = std::ldexp(m, rest);  // 0.5 to 4
  double root = m < 1 ? 0.4 + 0.6 * m : 0.82 + 0.2 * m;
  for (int i = 0; i < 5; ++i) root -= (root * root * root - m) / (3 * root * root);
  // One more step with the cube exact, so that cubes of short numbers come back exactly.
  const Sum square = two_part::product(root, root);
  const Sum cube = two_part::multiply(square, {root, 0});
  root -= ((cube.high - m) + cube.low) / (3 * root * root);
  return std::copysign(std::ldexp(root, (exponent - rest) / 3), x);
}

}  // namespace tweenfall::elementary
