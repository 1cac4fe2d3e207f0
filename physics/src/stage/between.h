#pragma once

#include "stage/stage_data.h"

namespace tweenfall::staging {

/// Whether a time lies between two states, so that something between them is shown; otherwise the later one is. A stage
/// that was loaded at the end of a step, which may lie a hair after its time, has nothing but that state.
[[nodiscard]] inline bool is_between(const StageState& from, const StageState& to, double time) {
  return from.time < to.time && time < to.time;
}

}  // namespace tweenfall::staging
