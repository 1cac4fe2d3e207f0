#pragma once

// One axis of a plot: from values to pixels, and where its ticks stand.

#include <vector>

namespace tweenfall {

struct Axis {
  double low = 0, high = 1;  ///< values at the ends; low < high
  double from = 0, to = 1;   ///< px of the ends

  [[nodiscard]] double place(double value) const { return from + (value - low) / (high - low) * (to - from); }
};

/// Round values (1, 2 or 5 times a power of ten apart) between the ends, about `count` of them.
[[nodiscard]] std::vector<double> ticks(const Axis& axis, int count);

/// Decimals that tell neighboring ticks apart.
[[nodiscard]] int tick_decimals(const std::vector<double>& ticks);

/// Widens [low, high] so that curves do not touch the frame; what is flat gets a range around it.
void add_room(double& low, double& high);

}  // namespace tweenfall
