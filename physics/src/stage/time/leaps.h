#pragma once

// Where what is scripted leaps: a step that begins before such an instant must end there.

#include <memory>

#include "stage/stage_data.h"

namespace tweenfall::staging {

[[nodiscard]] std::shared_ptr<const Leaps> leaps_of(const StageDescription& description);
/// The first leap in (from, to], no more than a step; infinity for none.
[[nodiscard]] double next_leap(const StageState& state, double from, double to);

}  // namespace tweenfall::staging
