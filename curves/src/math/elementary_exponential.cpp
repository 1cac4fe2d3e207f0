#include <tweenfall/curves/elementary.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "math/double_double.h"

namespace tweenfall::elementary {
namespace {

using two_part::Sum;

// The first part has 41 bits, so that its product with any exponent is exact.
constexpr double ln2_high = 0x1.62e42fefa3000p-1, ln2_low = 0x1.3de6af278ece6p-42;
constexpr double one_over_ln2 = 0x1.71547652b82fep+0;
constexpr double infinity = std::numeric_limits<double>::infinity();

double scaled(double value, int exponent) noexcept {
  if (exponent < -1021 || exponent > 1023) return std::ldexp(value, exponent);
  return value * std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

// exp(x.high + x.low) for |x| up to 746; the series leaves out terms below 1e-18.
double exp_of(const Sum& x) noexcept {
  const double k = std::floor(x.high * one_over_ln2 + 0.5);
  const Sum r = two_part::sum(x.high - k * ln2_high, -(k * ln2_low) + x.low);
  const double h = r.high;
  const double p =
      0.5 +
      h * (1.0 / 6 +
           h * (1.0 / 24 +
                h * (1.0 / 120 +
                     h * (1.0 / 720 +
                          h * (1.0 / 5040 +
                               h * (1.0 / 40320 +
                                    h * (1.0 / 362880 +
                                         h * (1.0 / 3628800 +
                                              h * (1.0 / 39916800 +
                                                   h * (1.0 / 479001600 +
                                                        h * (1.0 / 6227020800.0 + h * (1.0 / 87178291200.0))))))))))));
  const Sum head = two_part::quick_sum(1, h);
  return scaled(head.high + (head.low + (r.low + h * h * p)), static_cast<int>(k));
}

// Logarithm of a positive finite number to about 66 bits: log x = e log 2 + 2 artanh(s).
Sum log_of(double x) noexcept {
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0x1.6a09e667f3bcdp-1) {
    m *= 2;
    --exponent;
  }
  const Sum s = two_part::divide({m - 1, 0}, two_part::sum(1, m));
  const Sum square = two_part::multiply(s, s);
  const Sum cube = two_part::multiply(square, s);
  const double z = square.high;
  const double tail =
      z * cube.high *
      (2.0 / 5 +
       z * (2.0 / 7 +
            z * (2.0 / 9 +
                 z * (2.0 / 11 +
                      z * (2.0 / 13 +
                           z * (2.0 / 15 + z * (2.0 / 17 + z * (2.0 / 19 + z * (2.0 / 21 + z * (2.0 / 23))))))))));
  constexpr Sum two_thirds = {0x1.5555555555555p-1, 0x1.5555555555555p-55};
  Sum result = two_part::add({2 * s.high, 2 * s.low}, two_part::multiply(two_thirds, cube));
  result = two_part::add(result, {tail, 0});
  if (exponent == 0) return result;
  return two_part::add({exponent * ln2_high, 0}, two_part::add({exponent * ln2_low, 0}, result));
}

}  // namespace

double exp(double x) noexcept {
  if (x != x) return x;
  if (x > 709.8) return infinity;
  if (x < -745.2) return 0;
  return exp_of({x, 0});
}

double log(double x) noexcept {
  if (x == 0) return -infinity;
  if (!(x > 0)) return std::numeric_limits<double>::quiet_NaN();
  if (x == infinity) return x;
  const Sum l = log_of(x);
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
  const Sum l = log_of(x);
  const double rough = y * l.high;
  if (rough > 709.8) return infinity;
  if (rough < -745.2) return 0;
  if (std::abs(rough) < 0x1p-60) return 1;
  // A y too large for the split product only matters where x is close to 1.
  const double scale = std::abs(y) > 0x1p900 ? 0x1p-200 : 1;
  const Sum p = two_part::product(y * scale, l.high / scale);
  return exp_of(two_part::quick_sum(p.high, p.low + y * l.low));
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
