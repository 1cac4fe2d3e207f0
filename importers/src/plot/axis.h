#pragma once

// One axis of a plot: from values to pixels, and the places of its ticks.

#include <string>
#include <vector>

namespace tweenfall::plotting {

struct Axis {
  double low = 0, high = 1;  ///< values at the ends; low < high, both finite, far enough apart for ten distinct doubles
  double from = 0, to = 1;   ///< px of the ends

  [[nodiscard]] double place(double value) const { return from + (value - low) / (high - low) * (to - from); }
};

/// Round values (1, 2 or 5 times a power of ten apart) between the ends, about `count` of them. None where the axis has
/// no length or is infinite.
[[nodiscard]] std::vector<double> ticks(const Axis& axis, int count);

/// The labels of the ticks: as few digits as distinguish neighbors, with an exponent instead of many digits.
[[nodiscard]] std::vector<std::string> tick_texts(const std::vector<double>& ticks);

/// Widens [low, high] so that curves do not touch the frame; a flat curve gets a range around it.
void add_room(double& low, double& high);

}  // namespace tweenfall::plotting
