#pragma once

// What nodes look like in a graph.

#include <tweenfall/anim/node_look.h>

#include "graph/binder.h"

namespace tweenfall::graphs {

/// The mean of what the clips that show have for a node. @param below  what it looks like below the graph
[[nodiscard]] NodeLook look_of(const Log& log, const Graph& graph, std::size_t node, const Moment& moment,
                               const NodeLook& below);

}  // namespace tweenfall::graphs
