#pragma once

// The difference between the pose shown and that of the new state, and its decay.

#include "graph/log.h"

#include <span>

namespace tweenfall::graphs {

/// The offsets of the pose shown from that of the new state, at the same instant.
[[nodiscard]] std::vector<Offset> offsets_of(const GraphChange& change, std::span<const Motion> shown,
                                             std::span<const Motion> next);

/// The time until the offset is gone, s.
[[nodiscard]] double settling_time(const GraphChange& change) noexcept;

/// Adds the remainder of the offsets after `since` seconds to `motions`.
void settle(const GraphChange& change, std::span<const Offset> offsets, double since,
            std::span<Motion> motions) noexcept;

}  // namespace tweenfall::graphs
