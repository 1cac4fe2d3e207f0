#pragma once

#include "stage/stage_data.h"

namespace tweenfall::staging {

/// Of the world, and of everything else on a stage.
[[nodiscard]] std::uint64_t stage_hash(const StageState& state);

}  // namespace tweenfall::staging
