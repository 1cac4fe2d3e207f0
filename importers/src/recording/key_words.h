#pragma once

// A key in words: its value and how the curve leaves it.

#include <tweenfall/anim/track.h>

#include <string>
#include <vector>

namespace tweenfall::recordings {

/// The value of a track at a key, with four decimals at most: "(0, 1.5, 0)", rotations as "90° about (0, 0, 1)", colors
/// as linear "(r, g, b, a)".
[[nodiscard]] std::string key_value_text(const Track& track, double clip_time);

/// How the curve leaves each key: in the author's words or, without these, "hold", "linear", "eased" (a straight line
/// re-timed), "quadratic", "cubic", "quintic", or "several" where components differ; "end" for the last key.
[[nodiscard]] std::vector<std::string> key_ease_texts(const Track& track, const std::vector<double>& clip_times);

}  // namespace tweenfall::recordings
