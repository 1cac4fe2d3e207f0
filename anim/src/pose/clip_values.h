#pragma once

// Values of user tracks: at a clock, and mixed.

#include <tweenfall/anim/clip.h>
#include <tweenfall/anim/play.h>
#include <tweenfall/anim/user_value.h>

#include <span>
#include <string_view>

namespace tweenfall::pose {

/// The first track of that name among the user tracks of the clips. @throws std::invalid_argument with the nearest name
[[nodiscard]] const Track& user_track_named(std::span<const Clip> clips, std::string_view name);
[[nodiscard]] bool is_user_track(const Track& track) noexcept;

/// What shows where no clip has the track: a value of the same kind.
[[nodiscard]] UserValue nothing_of(const TrackCurve& kind);

/// A track at a clock, with the gains of a loop with offset and rates in stage time.
[[nodiscard]] UserValue user_value_of(const TrackCurve& curve, const ClipClock& clock);

/// The mean of values of one kind.
/// @param weights  one for each value; their sum is not 0. Below 0 what is taken away again, save for rotations
[[nodiscard]] UserValue mean_of(std::span<const UserValue> values, std::span<const Sample<double>> weights);

}  // namespace tweenfall::pose
