#pragma once

// The course of a graph: the consequences of its inputs, instant by instant.

#include "machine/machine.h"

namespace tweenfall::graphs {

/// At most this many transitions are kept for each machine; then it stays where it is.
inline constexpr std::size_t most_passages = 1'000'000;

/// At most this many instants without an input are examined, such as events of clips; after that only inputs have an
/// effect, so that no time is too far away to be requested.
inline constexpr std::size_t most_own_instants = 1'000'000;

/// Computes what happens until a time. @param room `rooms_of` poses
void make_known(Log& log, const Graph& graph, double until, const GraphGround& ground, std::span<Motion> room);

/// The number of scratch poses for evaluating a graph.
[[nodiscard]] std::size_t rooms_of(const Graph& graph) noexcept;

}  // namespace tweenfall::graphs
