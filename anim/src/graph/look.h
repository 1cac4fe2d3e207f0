#pragma once

// Colors, morph weights and user tracks in a graph.

#include <tweenfall/anim/node_look.h>
#include <tweenfall/anim/user_value.h>

#include "graph/binder.h"

#include <string_view>

namespace tweenfall::graphs {

/// The mean look of a node over the clips that show. @param below its look below the graph
[[nodiscard]] NodeLook look_of(const Log& log, const Graph& graph, std::size_t node, const Moment& moment,
                               const NodeLook& below);

/// The mean value of a user track, "node.property", over the clips that show.
/// @param node   of the track; `no_node` for none
/// @param below  its value below the graph
[[nodiscard]] UserValue user_value_of(const Log& log, const Graph& graph, std::string_view track, std::size_t node,
                                      const Moment& moment, const UserValue& below);

}  // namespace tweenfall::graphs
