#pragma once

#include "stage/stage_data.h"

namespace tweenfall::staging {

/// Of the world, and of what is on a stage beside it.
[[nodiscard]] std::uint64_t stage_hash(const StageState& state);

}  // namespace tweenfall::staging
