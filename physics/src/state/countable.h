#pragma once

#include <tweenfall/curves/values.h>

#include <cmath>

namespace tweenfall::state {

/// Limits of the numbers that a world accepts: their fourth powers are still far from the limits of a double.
constexpr double largest = 1e30;
constexpr double smallest = 1e-30;  ///< of values that must be positive

[[nodiscard]] inline bool countable(double value) {
  return std::abs(value) <= largest;
}
[[nodiscard]] inline bool countable(const Vec3& value) {
  return countable(value.x()) && countable(value.y()) && countable(value.z());
}

}  // namespace tweenfall::state
