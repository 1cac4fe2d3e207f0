#pragma once

// Bodies that lie in each other where one leaves its path.

#include <vector>

#include "stage/stage_data.h"

namespace tweenfall::staging {

/// The bodies in which one would lie at a pose, as they stand, by index; by more than a hair, and only those that it
/// may meet.
[[nodiscard]] std::vector<BodyId> bodies_in(const StageState& state, const StagedBody& body, const Pose& pose);

/// The last time before `instant`, by no more than `within`, at which the path was clear of all others as they stand.
[[nodiscard]] std::optional<double> last_clear(const StageState& state, const StagedBody& body, double instant,
                                               double within, double step);

/// Lets bodies that pass through each other until they are apart meet again where they are.
void end_passing(StageState& state);

}  // namespace tweenfall::staging
