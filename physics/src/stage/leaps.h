#pragma once

// Where what is scripted leaps: a step that begins before such an instant must end there.

#include <memory>
#include <vector>

#include "stage/stage_data.h"

namespace tweenfall::staging {

/// When strengths of forces and scripts of vehicles leap from one value to another, in order, s. Only keys tell; a
/// formula does not.
[[nodiscard]] std::shared_ptr<const std::vector<double>> leaps_of(const StageDescription& description);
/// The first of them in (from, to]; infinity for none.
[[nodiscard]] double next_leap(const StageState& state, double from, double to);

}  // namespace tweenfall::staging
