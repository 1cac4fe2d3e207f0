#pragma once

#include "stage/stage_data.h"

namespace tweenfall::staging {

class WholePose;

/// Where a driven body is wanted whose path is at `path`: there, or carried along with its drive's frame, from
/// where the path of that frame is to where the frame really is.
///
/// @param pose  of the animation, for which `path` was computed
/// @param end   time for which it is wanted, s; until then the carrying body
///              is predicted by its own velocity,
///              and by gravity if nothing holds it
[[nodiscard]] Motion carried_along(const StageState& state, const StagedBody& body, const Motion& path, WholePose& pose,
                                   double end);

}  // namespace tweenfall::staging
