#pragma once

// The two ways to bring the end of a chain to its target.

#include "chains/chain_shape.h"

namespace tweenfall::chains {

/// A chain without limits: sweeps by its method give the shape, least squares bring the end to the target.
void reach_freely(const JointChain& chain, const Arrow& target, ChainShape& shape) noexcept;

/// A chain with limits: the target goes from the end to where it is, and the joints follow.
void reach_within_limits(const JointChain& chain, const Arrow& target, ChainShape& shape) noexcept;

/// Turns all joints a little, the more the farther the target is from the end: a chain that lies straight on the line
/// to its target has nowhere else to begin.
void bend(const Arrow& target, ChainShape& shape) noexcept;

/// Solves the symmetric a x = b by cofactors; 0 where it has no one solution.
[[nodiscard]] Arrow solved(const Arrow (&a)[3], const Arrow& b) noexcept;

}  // namespace tweenfall::chains
