#pragma once

// The instants at which a curve is sampled to judge it.

#include <tweenfall/curves/curve.h>

#include <algorithm>
#include <cmath>

namespace tweenfall::document::judging {

// Calls `look(time, side)` on both sides of each key and half way between two or, if there are no keys, along
// `duration`, s.
template <class T, class Look>
void look_along(const Curve<T>& curve, double duration, Look look) {
  constexpr std::size_t most = 100'000;
  const auto look_at = [&](double time, Side side) {
    if (std::isfinite(time)) look(time, side);
  };
  const std::span<const double> knots = curve.knots();
  for (std::size_t i = 0; i < std::min(knots.size(), most); ++i) {
    look_at(knots[i], Side::out);
    look_at(knots[i], Side::in);
    if (i > 0) look_at(knots[i - 1] + (knots[i] - knots[i - 1]) / 2, Side::out);
  }
  if (knots.empty())
    for (int i = 0; i <= 16; ++i) look_at((std::isfinite(duration) ? duration : 1) * i / 16, Side::out);
}

}  // namespace tweenfall::document::judging
