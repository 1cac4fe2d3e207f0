#pragma once

// A search for the pose within its limits that brings the end of a chain nearest to a target, among all of them.

#include "chains/chain_shape.h"

namespace tweenfall::chains {

/// Whether the chain has few enough coordinates for it.
[[nodiscard]] bool is_searchable(const ChainShape& shape) noexcept;

/// From where it is to where it is nearest, downhill.
void descend(const Arrow& target, ChainShape& shape) noexcept;

/// To the nearest that it finds from where it is or from poses drawn within the limits, the same ones in each search;
/// of those at the target, the first one.
void search_everywhere(const Arrow& target, ChainShape& shape) noexcept;

/// The same from poses that are ever farther from where it is; of those at the target that are found from about as far,
/// the one that turns the joints least. Stays where it is if none is nearer.
void search_from_here(const Arrow& target, ChainShape& shape) noexcept;

}  // namespace tweenfall::chains
