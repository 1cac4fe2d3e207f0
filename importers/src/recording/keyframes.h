#pragma once

// Chooses a few frames between which the others lie on straight lines.

#include <tweenfall/curves/values.h>

#include <span>
#include <vector>

namespace tweenfall::recordings {

/// Indices of the frames to keep, first and last among them: between two consecutive ones, every point of every frame
/// lies within `tolerance` of the straight line in time.
/// @param starts  frames before which the points jump, in order, not 0: each and the one before it are kept, and no
/// line
///                joins them
///
/// Source: the splitting of D. Douglas and T. Peucker, 1973, with the distance at equal times in place of that to the
/// line.
[[nodiscard]] std::vector<std::size_t> key_frames(const std::vector<double>& times,
                                                  const std::vector<std::vector<Vec2>>& points, double tolerance,
                                                  std::span<const std::size_t> starts = {});

}  // namespace tweenfall::recordings
