#pragma once

// The two ways to bring the end of a chain to its target.

#include "chains/chain_shape.h"

namespace tweenfall::chains {

/// A chain without limits: sweeps by its method give the shape, least squares bring the end to the target.
void reach_freely(const JointChain& chain, const Arrow& target, ChainShape& shape) noexcept;

/// A chain with limits: the target moves from the end of the chain to its place, and the joints follow.
void reach_within_limits(const JointChain& chain, const Arrow& target, ChainShape& shape) noexcept;

/// The same from the pose of the chain before, in `shape`, on the branch on which it is: the joints go back toward
/// `home` by `share`, and from there follow the target. @param searches  elsewhere if the chain may leap and misses it
/// @return  whether the target is reached
bool follow_within_limits(const JointChain& chain, const Arrow& target, const ChainShape& home, const Dual& share,
                          bool searches, ChainShape& shape) noexcept;

/// Turns all joints a little, more for a target farther from the end: a chain that lies straight on the line to its
/// target could not start bending otherwise.
void bend(const Arrow& target, ChainShape& shape) noexcept;

/// Solves the symmetric a x = b by cofactors; 0 where there is no unique solution.
[[nodiscard]] Arrow solved(const Arrow (&a)[3], const Arrow& b) noexcept;

}  // namespace tweenfall::chains
