#pragma once

#include "forces/integrators/integrators.h"

namespace tweenfall::forces {

/// Solves by Newton's method for mean rates that are `known` plus `share` of the rates at the end of the step, where
/// these mean rates lead. If forces are linear, its first step is the closed form. Bodies that act on each other are
/// solved together; of more than 32, each takes the others as they were, again and again, and the limit is
/// extrapolated. If there is no solution, the nearest approach is taken.
/// @param means  written; as long as `known`
/// Source: Hairer and Wanner, Solving Ordinary Differential Equations II, IV.8.
void meet_the_end(const Flow& flow, double dt, double share, std::span<const double> known, std::span<double> means);

}  // namespace tweenfall::forces
