#pragma once

#include <cstdint>
#include <vector>

#include "islands/island_contents.h"

namespace tweenfall::islands {

/// The bodies of an island that its solver moved, and what else has a hold on them.
struct MovedBodies {
  MovedBodies(const IslandContents& island, const std::vector<state::Body>& bodies, const std::vector<char>& moved);

  bool held = false;               ///< by something immovable
  bool passive = true;             ///< nothing that moves by its own will gives energy
  bool sprung = false;             ///< springs store energy
  std::vector<std::uint32_t> all;  ///< in order, each once
};

}  // namespace tweenfall::islands
