#pragma once

/// Graphs of poses as SVG: how poses depend on each other, and each machine with its states and transitions.

#include <tweenfall/anim/graph.h>

#include <span>
#include <string>

namespace tweenfall {

/// Deterministic text. For each graph its clips and poses from left to right, connected by lines that state the role;
/// below, each machine: states as boxes, transitions as arrows with their conditions and the kind of change in words.
[[nodiscard]] std::string graph_svg(std::span<const GraphDescription> graphs);

}  // namespace tweenfall
