#pragma once

// The inputs of a graph as bytes, and back.

#include "graph/log.h"

#include <cstdint>
#include <span>

namespace tweenfall::graphs {

[[nodiscard]] std::vector<std::byte> bytes_of(const Log& log, const GraphDescription& description, double time);

struct SavedLog {
  Log log;  // none of its consequences are computed yet
  double time = 0;
};

/// @throws std::invalid_argument saying what is wrong with the bytes, or that they are of another graph
[[nodiscard]] SavedLog log_of(std::span<const std::byte> bytes, const GraphDescription& description,
                              const LogSizes& sizes);

/// A hash of the inputs and their consequences until a time.
[[nodiscard]] std::uint64_t hash_of(const Log& log, double time) noexcept;

}  // namespace tweenfall::graphs
