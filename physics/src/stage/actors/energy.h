#pragma once

// The energy of a stage's bodies.

#include "stage/stage_data.h"

namespace tweenfall::staging {

/// Between two consecutive states.
[[nodiscard]] StageEnergy stage_energy(const StageState& from, const StageState& to, double time);

}  // namespace tweenfall::staging
