#pragma once

/// Graphs of poses as SVG: what is made of what, and each machine with its states and transitions.

#include <tweenfall/anim/graph.h>

#include <span>
#include <string>

namespace tweenfall {

/// Deterministic text. Of each graph its clips and poses from left to right, lines saying what for; below, each
/// machine: states as boxes, transitions as arrows with their conditions in words and how the change is made.
[[nodiscard]] std::string graph_svg(std::span<const GraphDescription> graphs);

}  // namespace tweenfall
