#include <tweenfall/curves/elementary.h>

#include <cmath>

#include "math/double_double.h"

namespace tweenfall::elementary {
namespace {

// pi/2 in parts of 23 bits, so that products with a quadrant number up to 2^30 are exact.
constexpr double half_pi_parts[5] = {0x1.921fb40000000p+0, 0x1.4442d00000000p-24, 0x1.8469880000000p-48,
                                     0x1.8cc5140000000p-72, 0x1.80dc1cd129025p-95};
constexpr double two_over_pi = 0x1.45f306dc9c883p-1;

struct Reduced {
  two_part::Sum angle;  // in about -pi/4 to pi/4
  int quadrant;
};

Reduced reduce(double x) noexcept {
  if (std::abs(x) <= 0x1.921fb54442d18p-1) return {{x, 0}, 0};
  const double k = std::floor(x * two_over_pi + 0.5);
  two_part::Sum r = {x, 0};
  for (const double part : half_pi_parts) {
    const double p = k * part;
    const two_part::Sum s = two_part::sum(r.high, -p);
    r = two_part::quick_sum(s.high, s.low + r.low);
  }
  return {r, static_cast<int>(k - 4 * std::floor(k / 4))};
}

// Taylor series; on |r| <= pi/4 the terms left out are below 1e-19.
two_part::Sum sin_kernel(const two_part::Sum& r) noexcept {
  const double z = r.high * r.high;
  const double p =
      -1.0 / 6 +
      z * (1.0 / 120 +
           z * (-1.0 / 5040 + z * (1.0 / 362880 + z * (-1.0 / 39916800 + z * (1.0 / 6227020800.0 +
                                                                              z * (-1.0 / 1307674368000.0 +
                                                                                   z * (1.0 / 355687428096000.0)))))));
  return two_part::quick_sum(r.high, r.high * z * p + r.low * (1 - 0.5 * z));
}

two_part::Sum cos_kernel(const two_part::Sum& r) noexcept {
  const two_part::Sum square = two_part::product(r.high, r.high);
  const double z = square.high;
  const double p =
      1.0 / 24 +
      z * (-1.0 / 720 +
           z * (1.0 / 40320 + z * (-1.0 / 3628800 + z * (1.0 / 479001600.0 +
                                                         z * (-1.0 / 87178291200.0 + z * (1.0 / 20922789888000.0))))));
  const two_part::Sum head = two_part::quick_sum(1, -0.5 * z);
  return two_part::quick_sum(head.high, head.low + (z * z * p - 0.5 * square.low - r.high * r.low));
}

struct Pair {
  two_part::Sum sin, cos;
};

Pair both(double x) noexcept {
  const Reduced r = reduce(x);
  const two_part::Sum s = sin_kernel(r.angle), c = cos_kernel(r.angle);
  switch (r.quadrant) {
    case 0:
      return {s, c};
    case 1:
      return {c, {-s.high, -s.low}};
    case 2:
      return {{-s.high, -s.low}, {-c.high, -c.low}};
    default:
      return {{-c.high, -c.low}, s};
  }
}

}  // namespace

SinCos sin_cos(double x) noexcept {
  const Pair p = both(x);
  return {p.sin.high + p.sin.low, p.cos.high + p.cos.low};
}

double sin(double x) noexcept {
  return sin_cos(x).sin;
}

double cos(double x) noexcept {
  return sin_cos(x).cos;
}

double tan(double x) noexcept {
  const Pair p = both(x);
  const two_part::Sum q = two_part::divide(p.sin, p.cos);
  return q.high + q.low;
}

}  // namespace tweenfall::elementary
