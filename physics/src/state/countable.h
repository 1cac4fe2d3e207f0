#pragma once

#include <tweenfall/curves/values.h>

#include <cmath>

namespace tweenfall::state {

/// Numbers that a world takes: their squares, and the squares of those, are far from the ends of what a double holds.
constexpr double largest = 1e30;
constexpr double smallest = 1e-30;  ///< of what must be positive

[[nodiscard]] inline bool countable(double value) {
  return std::abs(value) <= largest;
}
[[nodiscard]] inline bool countable(const Vec3& value) {
  return countable(value.x()) && countable(value.y()) && countable(value.z());
}

}  // namespace tweenfall::state
