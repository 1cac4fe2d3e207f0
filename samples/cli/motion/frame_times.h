#pragma once

/// The times of frames, and the options that choose them.

#include <optional>
#include <vector>

namespace tweenfall::cli {

/// @throws UsageError naming the option, for frames per second or an end that make no sense, or too many frames.
void require_frames(double fps, double until);

/// 0, 1/fps, 2/fps, ... and `until` itself.
[[nodiscard]] std::vector<double> frame_times(double until, double fps);

}  // namespace tweenfall::cli
