#pragma once

// How far a chain that follows its target has come, on the clock of a `Swing`.

#include <tweenfall/anim/following_chain.h>

#include <cstdint>

namespace tweenfall::graphs {

/// More are not counted: the numbers would no longer be whole.
inline constexpr std::int64_t most_steps = std::int64_t{1} << 52;

struct ReachState {
  std::int64_t step = -1;  // of its grid; -1: it has not begun
  ChainMemory memory{};

  [[nodiscard]] std::vector<std::byte> bytes() const;
  /// @throws std::invalid_argument for bytes that are not such a state
  [[nodiscard]] static ReachState from_bytes(std::span<const std::byte> bytes);
};

}  // namespace tweenfall::graphs
