#pragma once

// The direction in which a number crosses a border that it is exactly on.

#include <tweenfall/curves/values.h>

#include <cmath>

namespace tweenfall::blending {

/// The sign of a number that is 0 now, just after (`Side::out`) or just before, from its rate and acceleration.
[[nodiscard]] inline int heading(double rate, double acceleration, Side side) noexcept {
  if (side == Side::in) rate = -rate;
  if (rate != 0) return rate > 0 ? 1 : -1;
  return acceleration > 0 ? 1 : acceleration < 0 ? -1 : 0;
}

/// The same for any number: its own sign, unless it is 0.
[[nodiscard]] inline int heading(const Sample<double>& number, Side side) noexcept {
  if (number.value != 0) return number.value > 0 ? 1 : -1;
  return heading(number.rate, number.acceleration, side);
}

/// A number in a frame of size 1 with all that is rounding in it left out, so that `heading` is that of what it means.
/// @param of  what it was made from
[[nodiscard]] inline Sample<double> without_rounding(Sample<double> number, const Sample<Vec2>& of) noexcept {
  constexpr double rounding = 1e-14;
  const auto clear = [](double& part, double size) {
    if (std::abs(part) <= rounding * size) part = 0;
  };
  clear(number.value, 1 + of.value.norm());
  clear(number.rate, of.rate.norm());
  clear(number.acceleration, of.acceleration.norm());
  return number;
}

}  // namespace tweenfall::blending
