#include <tweenfall/curves/elementary.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "math/elementary_series.h"

namespace tweenfall::elementary {
namespace {

using namespace series;

// The bits of 2/pi after the point, enough for the largest double.
constexpr std::uint32_t two_over_pi_bits[] = {
    0xa2f9836e, 0x4e441529, 0xfc2757d1, 0xf534ddc0, 0xdb629599, 0x3c439041, 0xfe5163ab, 0xdebbc561,
    0xb7246e3a, 0x424dd2e0, 0x06492eea, 0x09d1921c, 0xfe1deb1c, 0xb129a73e, 0xe88235f5, 0x2ebb4484,
    0xe99c7026, 0xb45f7e41, 0x3991d639, 0x835339f4, 0x9c845f8b, 0xbdf9283b, 0x1ff897ff, 0xde05980f,
    0xef2f118b, 0x5a0a6d1f, 0x6d367ecf, 0x27cb09b7, 0x4f463f66, 0x9e5fea2d, 0x7527bac7, 0xebe5f17b,
    0x3d0739f7, 0x8a5292ea, 0x6bfb5fb1, 0x1f8d5d08, 0x56033046, 0xfc7b6bab};

struct Reduced {
  two_part::Sum angle;  // in about -pi/4 to pi/4
  int quadrant;
};

// 32 bits of 2/pi from bit `first` on, counted from the point; bits before the point are 0.
std::uint32_t bits_from(int first) noexcept {
  if (first <= -32) return 0;
  if (first < 0) return two_over_pi_bits[0] >> -first;
  const std::uint32_t* word = &two_over_pi_bits[first / 32];
  const int shift = first % 32;
  return shift == 0 ? word[0] : (word[0] << shift) | (word[1] >> (32 - shift));
}

// For numbers beyond 2^30. The bits of 2/pi that x turns into multiples of 4 are left out; enough of the others are
// used that even close to a multiple of pi/2 some 70 binary digits of the angle are right. Source: Payne and Hanek,
// "Radian reduction for trigonometric functions", 1983.
Reduced reduce_large(double x) noexcept {
  constexpr int limbs = 6, point = 32 * limbs - 2;  // of the product: two bits of quadrant, then the fraction
  int exponent = 0;
  const double fraction = std::frexp(std::abs(x), &exponent);
  const auto digits = static_cast<std::uint64_t>(fraction * 0x1p53);  // |x| = digits 2^(exponent - 53)
  const std::uint64_t parts[2] = {digits & 0xffffffffu, digits >> 32};
  const int first = exponent - 53 - 2;  // the bit that contributes multiples of 2
  std::uint32_t product[limbs] = {};    // least limb first
  for (int part = 0; part < 2; ++part) {
    std::uint64_t carry = 0;
    for (int i = 0; i + part < limbs; ++i) {
      carry += product[i + part] + parts[part] * bits_from(first + 32 * (limbs - 1 - i));
      product[i + part] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
  }
  int quadrant = static_cast<int>(product[limbs - 1] >> 30);
  product[limbs - 1] &= 0x3fffffffu;
  const bool above = product[limbs - 1] >= 0x20000000u;  // nearer to the next quadrant: take the distance to it
  if (above) {
    quadrant += 1;
    std::uint64_t carry = 1;
    for (std::uint32_t& limb : product) {
      carry += static_cast<std::uint32_t>(~limb);
      limb = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    product[limbs - 1] &= 0x3fffffffu;
  }
  two_part::Sum share = {0, 0};
  for (int i = 0; i < limbs; ++i) {
    const two_part::Sum s = two_part::sum(std::ldexp(static_cast<double>(product[i]), 32 * i - point), share.high);
    share = two_part::quick_sum(s.high, s.low + share.low);
  }
  two_part::Sum angle = two_part::multiply(share, {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54});
  if (above != (x < 0)) angle = {-angle.high, -angle.low};
  return {angle, (x < 0 ? -quadrant : quadrant) & 3};
}

Reduced reduce(double x) noexcept {
  if (std::abs(x) <= quarter_pi) return {{x, 0}, 0};
  if (!std::isfinite(x)) return {{std::numeric_limits<double>::quiet_NaN(), 0}, 0};
  if (std::abs(x) > largest_angle) return reduce_large(x);
  const double k = quadrants_of(x);
  return {less_quadrants(x, k), static_cast<int>(k - 4 * std::floor(k / 4))};
}

struct Pair {
  two_part::Sum sin, cos;
};

Pair both(double x) noexcept {
  const Reduced r = reduce(x);
  const two_part::Sum s = sin_of(r.angle), c = cos_of(r.angle);
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
