#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "forces/free_flight.h"

namespace tweenfall {

using Pair = std::pair<std::uint32_t, std::uint32_t>;  ///< indices, smaller first

/// Sort and sweep over the bounds that bodies cover during a step.
class BroadPhase {
 public:
  /// Pairs whose swept bounds overlap and of which at least one member moves, by index.
  const std::vector<Pair>& find(const std::vector<Body>& bodies, const std::vector<Load>& loads, double margin,
                                double dt);

 private:
  struct Entry {
    Bounds bounds;
    std::uint32_t index;
    bool dynamic;  ///< awake and movable, keyed and on its way, or newly placed
    bool movable;
    std::uint32_t pairs;  ///< found so far
  };
  std::vector<Entry> entries_;
  std::vector<Entry> planes_;
  std::vector<Pair> pairs_;
};

}  // namespace tweenfall
