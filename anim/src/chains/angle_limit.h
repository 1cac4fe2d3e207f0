#pragma once

// Limits the angle between two directions: free at first, then slower and slower up to the limit.

#include "chains/moving.h"

#include <numbers>

namespace tweenfall::chains {

/// `direction`, no farther than `limit` from `middle` (both unit, rad): free up to `ease` before the limit. A direction
/// nearly opposite the middle is released, so that nothing snaps from one side to the other.
inline Arrow within_angle(const Arrow& direction, const Arrow& middle, double limit, double ease) noexcept {
  if (limit >= std::numbers::pi) return direction;
  // A smaller ease counts as none: it would be invisible, and its rates would be too large.
  constexpr double sharpest = 1e-9;  // rad
  const double eases = std::min(ease, limit), slow = eases < sharpest ? 0 : eases, free = limit - slow;
  const Measured side = measured(across(direction, middle));
  const Dual angle = angle_of(side.length, dot(direction, middle));
  if (angle.v <= free) return direction;
  if (side.length.v < 1e-12) return middle;
  Dual eased(limit);
  if (slow > 0) eased = Dual(free) + Dual(slow) * (Dual(1) - exponential((angle - Dual(free)) / Dual(-slow)));
  const double behind = std::min(std::numbers::pi - limit, 1.0);
  const Dual limited = eased * smooth_step((Dual(std::numbers::pi) - angle) / Dual(behind));
  const elementary::SinCos turn = elementary::sin_cos(limited.v);
  return Dual(turn.cos, -turn.sin * limited.d) * middle + Dual(turn.sin, turn.cos * limited.d) * side.unit;
}

}  // namespace tweenfall::chains
