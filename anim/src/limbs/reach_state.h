#pragma once

// How far a chain that follows its target has come, on the clock of a `Swing`.

#include <tweenfall/anim/following_chain.h>

#include <cstdint>

namespace tweenfall::graphs {

struct ReachState {
  std::int64_t step = -1;  // of its grid; -1: it has not begun
  ChainMemory memory{};

  [[nodiscard]] std::vector<std::byte> bytes() const;
  /// @throws std::invalid_argument for bytes that are not such a state
  [[nodiscard]] static ReachState from_bytes(std::span<const std::byte> bytes);
};

}  // namespace tweenfall::graphs
