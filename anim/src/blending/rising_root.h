#pragma once

// Where something that rises passes 0.

namespace tweenfall::blending {

/// A value and its derivative.
struct Rise {
  double value = 0, slope = 0;
};

/// The place between `low` and `high` at which something that never falls passes 0, to rounding. Follows its slope
/// (Newton's method) as long as that soon ends. Where it does not - slopes that change much can lead to and fro for
/// ever
/// - every second step halves what is left, so that it always ends.
/// @param over  gives a Rise from a place
/// @param at  first guess
template <class Over>
[[nodiscard]] double rising_root(const Over& over, double low, double high, double at) noexcept {
  constexpr int patience = 12;
  for (int round = 0;; ++round) {
    const Rise here = over(at);
    if (here.value == 0) return at;
    (here.value > 0 ? high : low) = at;
    double next = at - here.value / here.slope;
    if (!(next >= low && next <= high) || (round >= patience && round % 2 == 0)) {
      next = low + (high - low) / 2;
      if (next == low || next == high) return next;
    }
    if (next == at) return at;
    at = next;
  }
}

}  // namespace tweenfall::blending
