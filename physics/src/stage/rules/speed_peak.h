#pragma once

#include "stage/stage_data.h"

namespace tweenfall::staging {

/// The first time in (from, to] at which the speed of a led body's center of mass on its path has risen and starts to
/// fall; infinity for none, and for a free body.
[[nodiscard]] double speed_peak(const StageState& state, const StagedBody& body, double from, double to);

}  // namespace tweenfall::staging
