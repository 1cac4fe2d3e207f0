#pragma once

// What a stage's bodies have of energy.

#include "stage/stage_data.h"

namespace tweenfall::staging {

/// Between two states that follow each other.
[[nodiscard]] StageEnergy stage_energy(const StageState& from, const StageState& to, double time);

}  // namespace tweenfall::staging
