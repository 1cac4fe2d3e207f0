#pragma once

// Where scripts jump: a step that starts before such an instant must end there.

#include <memory>

#include "stage/stage_data.h"

namespace tweenfall::staging {

[[nodiscard]] std::shared_ptr<const Leaps> leaps_of(const StageDescription& description);
/// The first jump in (from, to], which is at most a step long; infinity for none.
[[nodiscard]] double next_leap(const StageState& state, double from, double to);

}  // namespace tweenfall::staging
