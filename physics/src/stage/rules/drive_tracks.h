#pragma once

// Drives that clips animate: tracks named "drive_hz".

#include "stage/stage_data.h"

namespace tweenfall::staging {

/// Those of all clips, in order of their nodes.
/// @throws std::invalid_argument naming a track that carries no numbers or whose node has no body that can be driven
[[nodiscard]] std::shared_ptr<const std::vector<DriveTrack>> find_drive_tracks(const StageState& state);

/// Finds them, and has each body begin with the drive that it is given: that is no hand-off.
void start_drive_tracks(StageState& state);

/// Gives each body the drive that its tracks have now, until a rule or the caller has handed the body over.
void follow_drive_tracks(StageState& state, double step, std::vector<Happening>& happenings);

}  // namespace tweenfall::staging
