#pragma once

// Where a figure of a picture jumps, so that no line is drawn from there to here.

#include "figures/figures.h"

#include <vector>

namespace tweenfall::recordings {

struct FigureJump {
  std::size_t frame;  ///< the first that shows the figure beyond it; not 0
  double time;        ///< s, later than the frame before
};

/// Of the node that a figure shows and of those above it, and of a stick figure of all its nodes too: the first jump
/// between two frames, in order.
[[nodiscard]] std::vector<FigureJump> jumps_of(const figures::Figure& figure, const Recording& recording);

/// The frames of jumps.
[[nodiscard]] std::vector<std::size_t> frames_of(const std::vector<FigureJump>& jumps);

}  // namespace tweenfall::recordings
