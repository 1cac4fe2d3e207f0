#pragma once

// Properties of a body's physics that clips animate: tracks named "drive_hz" and "surface_velocity".

#include "stage/stage_data.h"

#include <string_view>

namespace tweenfall::staging {

/// Whether a track of this name, "node.property", is such a one.
[[nodiscard]] bool drives_a_body(std::string_view track);

/// Finds the tracks, and lets each body start with the drive that they give it: that is no hand-off.
/// @throws std::invalid_argument naming a track whose values are of another kind, or whose node has no body for it
void start_played_tracks(StageState& state);

/// Gives each body the drive that its tracks have now, until a rule or the caller has handed the body over, and its
/// surface the velocity.
void follow_played_tracks(StageState& state, double step, std::vector<Happening>& happenings);

}  // namespace tweenfall::staging
