#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "islands/free_islands.h"
#include "islands/island_contents.h"

namespace tweenfall::islands {

/// Jointed bodies that something immovable holds or bears: blows that joints hand on to much lighter bodies leave them
/// with more energy than they had and were given. All of them slow down together, so that their joints hold, until
/// they have gained no more than passes for an error.
/// @param moved  by index: set for the bodies that the solver moved
void bound_jointed(const IslandContents& island, std::vector<state::Body>& bodies,
                   const std::vector<forces::Load>& loads, const std::vector<char>& moved, double dt,
                   const std::function<FreeStart(std::uint32_t)>& start_of);

}  // namespace tweenfall::islands
