#pragma once

// The direction in which a number crosses a border that it is exactly on.

#include <tweenfall/curves/values.h>

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

}  // namespace tweenfall::blending
