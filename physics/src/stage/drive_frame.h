#pragma once

#include "stage/stage_data.h"

namespace tweenfall::staging {

class WholePose;

/// Where a driven body is wanted whose path is at `path`: there, or carried along with what its drive's frame is, from
/// where the path of that is to where it really is.
///
/// @param pose  of the animation, when `path` was asked
/// @param end   for when it is wanted, s; what carries it is where its own velocity, and its weight if nothing holds
/// it,
///              take it until then
[[nodiscard]] Motion carried_along(const StageState& state, const StagedBody& body, const Motion& path, WholePose& pose,
                                   double end);

}  // namespace tweenfall::staging
