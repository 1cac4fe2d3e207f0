#pragma once

// The course of a graph: what follows from what came in, instant by instant.

#include "machine/machine.h"

namespace tweenfall::graphs {

/// Of each machine at most so many transitions are kept; then it stays where it is.
inline constexpr std::size_t most_passages = 1'000'000;

/// So often a graph looks what happens of itself, as time goes on and clips tell their events; then only what comes in
/// leads it anywhere, so that no time is too far away to be asked for.
inline constexpr std::size_t most_own_instants = 1'000'000;

/// Makes known what happens until a time. @param room  `rooms_of` poses
void make_known(Log& log, const Graph& graph, double until, const GraphGround& ground, std::span<Motion> room);

/// Poses that a graph is evaluated in.
[[nodiscard]] std::size_t rooms_of(const Graph& graph) noexcept;

}  // namespace tweenfall::graphs
