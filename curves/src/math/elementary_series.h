#pragma once

// Sine, cosine, exponential, logarithm and powers of numbers that are no special cases: additions, multiplications,
// divisions and choices alone, so that a loop over many numbers is done several at a time and gives for each the bits
// that it has by itself.

#include <tweenfall/curves/elementary.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "math/double_double.h"

#define TWEENFALL_INLINED [[gnu::always_inline]] inline

namespace tweenfall::elementary::series {

using two_part::Sum;

// pi/2 in parts of 23 bits, so that products with a quadrant number up to 2^30 are exact.
inline constexpr double half_pi_parts[5] = {0x1.921fb40000000p+0, 0x1.4442d00000000p-24, 0x1.8469880000000p-48,
                                            0x1.8cc5140000000p-72, 0x1.80dc1cd129025p-95};
inline constexpr double two_over_pi = 0x1.45f306dc9c883p-1, quarter_pi = 0x1.921fb54442d18p-1;
inline constexpr double largest_angle = 0x1p30;
// The first part has 41 bits, so that its product with any exponent is exact.
inline constexpr double ln2_high = 0x1.62e42fefa3000p-1, ln2_low = 0x1.3de6af278ece6p-42;
inline constexpr double one_over_ln2 = 0x1.71547652b82fep+0;
// Beyond, an exponential may lie outside the range of numbers with all their digits.
inline constexpr double largest_exponent = 700;
inline constexpr double smallest_normal = 0x1p-1022, largest_number = 0x1.fffffffffffffp+1023;

/// std::floor of a number up to 2^50, without a call.
TWEENFALL_INLINED double floor_of(double x) noexcept {
  constexpr double units = 0x1.8p52;  // numbers of this size have no binary places
  const double near = (x + units) - units;
  return near > x ? near - 1 : near;
}

/// Which multiple of pi/2 is nearest.
TWEENFALL_INLINED double quadrants_of(double x) noexcept {
  return std::abs(x) <= quarter_pi ? 0 : floor_of(x * two_over_pi + 0.5);
}

/// x - k pi/2, for whole numbers k up to 2^30.
TWEENFALL_INLINED Sum less_quadrants(double x, double k) noexcept {
  Sum r = {x, 0};
  for (const double part : half_pi_parts) {
    const Sum s = two_part::sum(r.high, -(k * part));
    r = two_part::quick_sum(s.high, s.low + r.low);
  }
  return r;
}

// Taylor series; on |r| <= pi/4 the terms left out are below 1e-19.
TWEENFALL_INLINED Sum sin_of(const Sum& r) noexcept {
  const double z = r.high * r.high;
  const double p =
      -1.0 / 6 +
      z * (1.0 / 120 +
           z * (-1.0 / 5040 + z * (1.0 / 362880 + z * (-1.0 / 39916800 + z * (1.0 / 6227020800.0 +
                                                                              z * (-1.0 / 1307674368000.0 +
                                                                                   z * (1.0 / 355687428096000.0)))))));
  return two_part::quick_sum(r.high, r.high * z * p + r.low * (1 - 0.5 * z));
}

TWEENFALL_INLINED Sum cos_of(const Sum& r) noexcept {
  const Sum square = two_part::product(r.high, r.high);
  const double z = square.high;
  const double p =
      1.0 / 24 +
      z * (-1.0 / 720 +
           z * (1.0 / 40320 + z * (-1.0 / 3628800 + z * (1.0 / 479001600.0 +
                                                         z * (-1.0 / 87178291200.0 + z * (1.0 / 20922789888000.0))))));
  const Sum head = two_part::quick_sum(1, -0.5 * z);
  return two_part::quick_sum(head.high, head.low + (z * z * p - 0.5 * square.low - r.high * r.low));
}

/// Of an angle k quadrants further on.
TWEENFALL_INLINED SinCos turned(const SinCos& wave, double k) noexcept {
  const double half = 0.5 * k, quarter = 0.25 * k;
  const bool crossed = half != floor_of(half), beyond = quarter - floor_of(quarter) >= 0.5;  // quadrants 1, 3; 2, 3
  const double sin = crossed ? wave.cos : wave.sin, cos = crossed ? wave.sin : wave.cos;
  return {beyond ? -sin : sin, crossed != beyond ? -cos : cos};
}

/// exp(x.high + x.low) / 2^k for the k of `powers_of_two_in`; the series leaves out terms below 1e-18.
TWEENFALL_INLINED double exp_less_powers(const Sum& x, double k) noexcept {
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
  return head.high + (head.low + (r.low + h * h * p));
}
TWEENFALL_INLINED double powers_of_two_in(double x) noexcept {
  return floor_of(x * one_over_ln2 + 0.5);
}

/// For |x| up to `largest_exponent`.
TWEENFALL_INLINED double exp_of(const Sum& x) noexcept {
  const double k = powers_of_two_in(x.high);
  // The last digits of this sum are the exponent of 2^k as numbers hold it.
  const auto digits = std::bit_cast<std::uint64_t>(k + (1023 + 0x1.8p52));
  return exp_less_powers(x, k) * std::bit_cast<double>(digits << 52);
}

/// Logarithm of m 2^exponent, m from sqrt(1/2) to sqrt(2), to about 66 bits: log x = e log 2 + 2 artanh(s).
TWEENFALL_INLINED Sum log_of(double m, double exponent) noexcept {
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
  const Sum whole =
      two_part::add({exponent * ln2_high, 0}, two_part::add({exponent * ln2_low, 0}, {result.high, result.low}));
  return {exponent == 0 ? result.high : whole.high, exponent == 0 ? result.low : whole.low};
}

/// For x from `smallest_normal` to `largest_number`.
TWEENFALL_INLINED Sum log_of(double x) noexcept {
  constexpr std::uint64_t digits = 0x000fffffffffffffu, of_half = 0x3fe0000000000000u;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const double m = std::bit_cast<double>((bits & digits) | of_half);  // 1/2 to 1
  constexpr double offset = 0x1p52;
  const double exponent = std::bit_cast<double>((bits >> 52) | std::bit_cast<std::uint64_t>(offset)) - (offset + 1022);
  const bool small = m < 0x1.6a09e667f3bcdp-1;
  return log_of(small ? 2 * m : m, small ? exponent - 1 : exponent);
}

/// y log x, for y up to 2^900 and x as above.
TWEENFALL_INLINED Sum exponent_of_power(double x, double y) noexcept {
  const Sum l = log_of(x);
  const Sum p = two_part::product(y, l.high);
  return two_part::quick_sum(p.high, p.low + y * l.low);
}

}  // namespace tweenfall::elementary::series
