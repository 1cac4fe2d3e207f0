#pragma once

// Weights divided by their sum, with their rates.

#include <tweenfall/curves/values.h>

#include <cmath>

namespace tweenfall::blending {

/// The weight of a layer: negative weights count as 0.
[[nodiscard]] inline Sample<double> above_nothing(const Sample<double>& weight) noexcept {
  return weight.value >= 0 ? weight : Sample<double>{0, 0, 0};
}

/// The sum of the weights, and the weight of the rest pose that is missing to the least.
struct Whole {
  Sample<double> sum{0, 0, 0};
  Sample<double> filling{0, 0, 0};

  void add(const Sample<double>& weight) noexcept {
    sum.value += weight.value;
    sum.rate += weight.rate;
    sum.acceleration += weight.acceleration;
  }
  void fill_up_to(double least) noexcept {
    if (!(sum.value < least)) return;
    filling = {least - sum.value, -sum.rate, -sum.acceleration};
    sum = {least, 0, 0};
  }
  [[nodiscard]] bool is_nothing() const noexcept { return !(sum.value > 1e-100) || !(sum.value < 1e300); }

  /// w / sum; rates that are not finite, as for extremely small weights, count as 0.
  [[nodiscard]] Sample<double> share(const Sample<double>& weight) const noexcept {
    const double value = weight.value / sum.value;
    const double rate = (weight.rate - value * sum.rate) / sum.value;
    const double acceleration = (weight.acceleration - value * sum.acceleration - 2 * rate * sum.rate) / sum.value;
    return {value, std::isfinite(rate) ? rate : 0, std::isfinite(acceleration) ? acceleration : 0};
  }
};

[[nodiscard]] inline bool counts(const Sample<double>& weight) noexcept {
  return weight.value != 0 || weight.rate != 0 || weight.acceleration != 0;
}

}  // namespace tweenfall::blending
