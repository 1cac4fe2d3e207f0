#pragma once

// Colors and morph weights of nodes in a graph.

#include <tweenfall/anim/node_look.h>

#include "graph/binder.h"

namespace tweenfall::graphs {

/// The mean look of a node over the clips that show. @param below its look below the graph
[[nodiscard]] NodeLook look_of(const Log& log, const Graph& graph, std::size_t node, const Moment& moment,
                               const NodeLook& below);

}  // namespace tweenfall::graphs
