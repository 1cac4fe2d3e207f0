#pragma once

// Tracks of rotations, in each of their spellings.

#include <tweenfall/curves/curve.h>

#include "document/read/clip_times.h"

namespace tweenfall::document {

// `track` is a list of keys or an object. Empty where faulty.
[[nodiscard]] std::optional<Curve<Quat>> read_rotation_track(const json::Value& track, const ClipTimes& times,
                                                             Problems& problems);

// The angle of one axis, in radians, from plain degrees.
[[nodiscard]] std::optional<Curve<double>> read_angle_track(const json::Value& track, const ClipTimes& times,
                                                            Problems& problems);

}  // namespace tweenfall::document
