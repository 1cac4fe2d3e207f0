#pragma once

/// What is worth knowing of a track before using it: its keys, how fast it gets, where it jumps.

#include <tweenfall/anim/clip.h>

#include <vector>

namespace tweenfall::cli {

struct TrackSurvey {
  std::size_t keys = 0;     ///< as written; 0 for a constant or a formula
  double from = 0, to = 0;  ///< first and last knot, s; infinite for an endless formula
  double top_speed = 0;     ///< greatest length of the rate found within the clip, per second (rotations: rad/s)
  double top_speed_at = 0;  ///< clip time, s
  std::vector<double> value_jumps;  ///< times of inner keys at which the value jumps, s
  std::vector<double> slope_jumps;  ///< times of inner keys at which only the rate jumps, s
};

/// Speeds are searched from the start of the clip to its end, or over `endless` seconds if it has none.
[[nodiscard]] TrackSurvey survey(const Track& track, const Clip& clip, double endless = 10);

}  // namespace tweenfall::cli
