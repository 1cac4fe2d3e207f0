#pragma once

// What came in to a graph, as bytes and back.

#include "graph/log.h"

#include <cstdint>
#include <span>

namespace tweenfall::graphs {

[[nodiscard]] std::vector<std::byte> bytes_of(const Log& log, const GraphDescription& description, double time);

struct SavedLog {
  Log log;  // nothing of what follows from it is known yet
  double time = 0;
};

/// @throws std::invalid_argument telling what is wrong with the bytes, or that they are of another graph
[[nodiscard]] SavedLog log_of(std::span<const std::byte> bytes, const GraphDescription& description,
                              const LogSizes& sizes);

/// Of what came in and what followed until a time.
[[nodiscard]] std::uint64_t hash_of(const Log& log, double time) noexcept;

}  // namespace tweenfall::graphs
