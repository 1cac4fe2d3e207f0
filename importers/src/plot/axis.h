#pragma once

// One axis of a plot: from values to pixels, and where its ticks stand.

#include <string>
#include <vector>

namespace tweenfall::plotting {

struct Axis {
  double low = 0, high = 1;  ///< values at the ends; low < high, both finite and no closer than doubles can tell ten of
  double from = 0, to = 1;   ///< px of the ends

  [[nodiscard]] double place(double value) const { return from + (value - low) / (high - low) * (to - from); }
};

/// Round values (1, 2 or 5 times a power of ten apart) between the ends, about `count` of them. None where the axis has
/// no length or no end.
[[nodiscard]] std::vector<double> ticks(const Axis& axis, int count);

/// What stands at the ticks: as few digits as tell neighbors apart, with an exponent where they would be many.
[[nodiscard]] std::vector<std::string> tick_texts(const std::vector<double>& ticks);

/// Widens [low, high] so that curves do not touch the frame; what is flat gets a range around it.
void add_room(double& low, double& high);

}  // namespace tweenfall::plotting
