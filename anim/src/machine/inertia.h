#pragma once

// The difference between what was shown and what shall be, and how it dies away.

#include "graph/log.h"

#include <span>

namespace tweenfall::graphs {

/// From what was shown to what the new state shows, at the same instant.
[[nodiscard]] std::vector<Offset> offsets_of(const GraphChange& change, std::span<const Motion> shown,
                                             std::span<const Motion> next);

/// How long it takes until nothing is left, s.
[[nodiscard]] double settling_time(const GraphChange& change) noexcept;

/// What is left of the offsets after `since` seconds, put on top of `motions`.
void settle(const GraphChange& change, std::span<const Offset> offsets, double since,
            std::span<Motion> motions) noexcept;

}  // namespace tweenfall::graphs
