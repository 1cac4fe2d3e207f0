#pragma once

/// What a graph accepts, but perhaps was not meant.

#include <tweenfall/anim/graph.h>

#include <vector>

namespace tweenfall {

/// Tells, with the place, of states of machines to which no transition leads, and of blends whose weights sum to zero
/// for a while: from the start to a key, between keys, or from a key on. Only weights that are numbers or have keys are
/// known in advance.
[[nodiscard]] std::vector<GraphFault> doubts_about(const GraphDescription& description);

}  // namespace tweenfall
