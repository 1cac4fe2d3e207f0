#pragma once

#include "forces/integrators/integrators.h"

namespace tweenfall::forces {

/// Mean rates that are `known` and a share of what there is at the end of the step, to which they lead themselves: by
/// Newton's method. Where forces are linear its first step is the closed form. Bodies that are tied together are solved
/// for together; of more than 32 of them each takes the others as they were, over and over, and where that leads is
/// extrapolated. What cannot be met is met as nearly as it was.
/// @param means  written; as long as `known`
/// Source: Hairer and Wanner, Solving Ordinary Differential Equations II, IV.8.
void meet_the_end(const Flow& flow, double dt, double share, std::span<const double> known, std::span<double> means);

}  // namespace tweenfall::forces
