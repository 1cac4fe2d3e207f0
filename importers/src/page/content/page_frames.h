#pragma once

// Chooses the frames of a recording for its page, and converts numbers to single precision.

#include <tweenfall/physics/stage/recording.h>

#include <limits>
#include <vector>

namespace tweenfall::page {

/// Greatest number of places of moving nodes in a page, counting one for each frame and node.
inline constexpr std::size_t most_page_places = 250 * 1000;

/// Indices of frames, increasing, the first and the last among them: all of them, unless that would be more than
/// `most_page_places`; then evenly spaced ones, and those on both sides of a hand-off.
[[nodiscard]] std::vector<std::size_t> page_frames(const Recording& recording);

/// In single precision; infinite beyond 1e30, where computations of graphics would overflow.
[[nodiscard]] inline float single(double value) {
  constexpr double most = 1e30;
  constexpr float infinite = std::numeric_limits<float>::infinity();
  return value > most ? infinite : value < -most ? -infinite : static_cast<float>(value);
}

}  // namespace tweenfall::page
