#include "forces/kinds/kinds.h"

#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/number_text.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "state/checks.h"

namespace tweenfall::forces {

namespace {

/// x^y to 4e-14, in a sixth of the time that full precision takes: a hundred thousand particles need it twice
/// in a step. @param x  1e-60 to 1e60  @param y  -5 to 5
///
/// x = 2^e m with m from sqrt(1/2) to sqrt(2), log m = 2 artanh((m - 1) / (m + 1)), and exp by its Taylor series around
/// the nearest power of 2; what the series leave out is below 1e-17. Odd and even terms are summed side by side.
double power_of(double x, double y) {
  constexpr double nearest = 0x1.8p52;  // added and taken away, it leaves a whole number
  constexpr double one_over_ln2 = 0x1.71547652b82fep+0, ln2_high = 0x1.62e42fefa3000p-1,
                   ln2_low = 0x1.3de6af278ece6p-42;
  constexpr std::uint64_t to_root = 0x3ff0000000000000u - 0x3fe6a09e667f3bcdu;
  const std::uint64_t raised = std::bit_cast<std::uint64_t>(x) + to_root;
  const auto exponent = static_cast<double>(static_cast<std::int64_t>(raised >> 52) - 1023);
  const double m = std::bit_cast<double>((raised & 0x000fffffffffffffu) + 0x3fe6a09e667f3bcdu);
  const double s = (m - 1) / (m + 1), z = s * s, zz = z * z;
  const double log_odd = 1.0 / 3 + zz * (1.0 / 7 + zz * (1.0 / 11 + zz * (1.0 / 15 + zz * (1.0 / 19))));
  const double log_even = 1.0 / 5 + zz * (1.0 / 9 + zz * (1.0 / 13 + zz * (1.0 / 17 + zz * (1.0 / 21))));
  const double of_m = y * (2 * (s + s * z * (log_odd + z * log_even)));
  const double all = y * exponent, whole = (all + of_m * one_over_ln2 + nearest) - nearest;
  const double rest = (all - whole) * ln2_high + ((all - whole) * ln2_low + of_m);
  const double h = rest, hh = h * h;
  const double exp_even =
      0.5 + hh * (1.0 / 24 + hh * (1.0 / 720 + hh * (1.0 / 40320 + hh * (1.0 / 3628800 + hh * (1.0 / 479001600)))));
  const double exp_odd =
      1.0 / 6 +
      hh * (1.0 / 120 + hh * (1.0 / 5040 + hh * (1.0 / 362880 + hh * (1.0 / 39916800 + hh * (1.0 / 6227020800.0)))));
  const double value = 1 + (h + hh * (exp_even + h * exp_odd));
  return value * std::bit_cast<double>(static_cast<std::uint64_t>(static_cast<std::int64_t>(whole) + 1023) << 52);
}

}  // namespace

double fall_off(double square, double power) {
  if (!(square > 0)) return 0;
  if (power == 2) return 1 / (square * std::sqrt(square));
  if (power == 1) return 1 / square;
  if (power == 0) return 1 / std::sqrt(square);
  if (power == -1) return 1;
  const double exponent = -0.5 * (power + 1);
  return square >= 1e-60 && square <= 1e60 ? power_of(square, exponent) : elementary::pow(square, exponent);
}

void require_power(double power, const char* name) {
  constexpr double least = -4, most = 8;
  state::require(power >= least && power <= most,
                 "power of " + std::string(name) + " must lie in -4 to 8, but is " + number_text(power));
}

}  // namespace tweenfall::forces
