#pragma once

// Zeros between two places of different sign.

namespace tweenfall::math {

/// Place between `from` and `to` at which `f` changes sign, to the last bit; it must have different signs there.
template <class F>
[[nodiscard]] double crossing(const F& f, double from, double to) {
  const bool positive = f(from) > 0;
  for (int i = 0; i < 2100; ++i) {
    const double middle = from + 0.5 * (to - from);
    if (middle <= from || middle >= to) break;
    ((f(middle) > 0) == positive ? from : to) = middle;
  }
  return from + 0.5 * (to - from);
}

}  // namespace tweenfall::math
