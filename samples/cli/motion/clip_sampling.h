#pragma once

/// A clip's tracks at a moment, as numbers and as JSON.

#include <tweenfall/importers/track_sample.h>
#include <tweenfall/physics/stage/description.h>

#include <optional>
#include <string>
#include <vector>

namespace tweenfall::cli {

/// What a track's value is, in one word: "number", "vector", "color", "rotation", "weights", "switch", "text".
[[nodiscard]] const char* kind_of(const TrackCurve& curve) noexcept;

/// The indices of the tracks whose names match any of the patterns ("arm.*"); without patterns, of all.
/// @throws UsageError for a pattern that matches none, with the nearest name.
[[nodiscard]] std::vector<std::size_t> choose_tracks(const Clip& clip, const std::vector<std::string>& patterns);

/// The track at `time` on the clip's timeline: a loop wraps the time first; without one, the curve's own rules hold
/// before its first and after its last key. At the very end of the clip it is the motion that arrives there, with which
/// a hand-off at the clip's end releases the body.
[[nodiscard]] TrackSample sample_track(const Clip& clip, const Track& track, double time);

[[nodiscard]] std::string value_json(const TrackCurve& curve, const TrackSample& sample);
[[nodiscard]] std::string rate_json(const TrackCurve& curve, const TrackSample& sample);

/// World motion of every node while `clip` alone plays.
[[nodiscard]] std::vector<WorldMotion> sample_world(const Animation& animation, double time);

/// The nodes of a stage with one clip of it playing from 0.
[[nodiscard]] Animation animation_of(const StageDescription& stage, std::size_t clip);

}  // namespace tweenfall::cli
