#pragma once

// Tracks and clips from checked trees.

#include <tweenfall/anim/clip.h>
#include <tweenfall/curves/keys.h>

#include "document/form.h"
#include "document/read/clip_times.h"
#include "document/report/problems.h"

#include <optional>

namespace tweenfall::document {

// Empty where the track is faulty, which is reported.
[[nodiscard]] std::optional<Track> read_track(const json::Member& track, const ClipTimes& times, Problems& problems);

[[nodiscard]] Clip read_clip(const json::Member& clip, std::optional<double> fps, Problems& problems);

// Keys of one number in seconds of their own.
[[nodiscard]] std::optional<Curve<double>> read_plain_keys(const json::Value& keys, Problems& problems);

// Keys of one number on the clock of a play or of the stage, which has no end.
// @param number the form of each number
// @param from time at which the play's time is 0, s
[[nodiscard]] std::optional<Curve<double>> read_play_keys(const json::Value& keys, std::optional<double> fps,
                                                          const Form& number, double from, Problems& problems);

}  // namespace tweenfall::document
