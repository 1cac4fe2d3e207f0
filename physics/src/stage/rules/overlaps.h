#pragma once

// Bodies that overlap when one leaves its path.

#include <vector>

#include "stage/stage_data.h"

namespace tweenfall::staging {

/// The bodies that one would overlap at a pose, for their present poses, by index; by more than a hair, and only those
/// that it may meet.
[[nodiscard]] std::vector<BodyId> bodies_in(const StageState& state, const StagedBody& body, const Pose& pose);

/// The last time before `instant`, by at most `within`, at which the path was clear of all others as they are now.
[[nodiscard]] std::optional<double> last_clear(const StageState& state, const StagedBody& body, double instant,
                                               double within, double step);

/// Lets bodies that pass through each other meet again once they are apart.
void end_passing(StageState& state);

}  // namespace tweenfall::staging
