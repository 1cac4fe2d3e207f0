#pragma once

// Functions that stand in place of keys, and what happens outside keys.

#include <tweenfall/anim/track.h>
#include <tweenfall/curves/keys.h>

#include "document/problems.h"

#include <optional>

namespace tweenfall::document {

// What a track has instead of keys.
[[nodiscard]] bool has_function(const JsonValue& track);

// Such a track's curve: a number, or a vector. Empty where it is faulty, which then is noted.
[[nodiscard]] std::optional<TrackCurve> read_function(const JsonValue& track, Problems& problems);

// The same for an angle about an axis, in radians.
[[nodiscard]] std::optional<Curve<double>> read_angle_function(const JsonValue& track, Problems& problems);

[[nodiscard]] Outside outside_of(const JsonValue& track, std::string_view side);  // "before" or "after"

[[nodiscard]] Ends ends_of(const JsonValue& track);

template <class T>
[[nodiscard]] Curve<T> with_outside_of(const JsonValue& track, const Curve<T>& curve) {
  return curve.with_outside(outside_of(track, "before"), outside_of(track, "after"));
}

}  // namespace tweenfall::document
