#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "islands/free_islands.h"
#include "islands/island_contents.h"

namespace tweenfall::islands {

/// Springs that swing bodies faster than any step follows, as on the end of a lever, leave them with more energy than
/// they and their springs had and were given. Then the bodies go only a part of their way, as far as their springs may
/// be stretched, and slow down until they have gained no more than passes for an error. What nothing holds keeps its
/// momentum and its angular momentum.
/// @param moved  by index: set for the bodies that the solver moved
void bound_sprung(const IslandContents& island, std::vector<state::Body>& bodies,
                  const std::vector<forces::Load>& loads, const std::vector<char>& moved, double dt,
                  const std::function<FreeStart(std::uint32_t)>& start_of);

}  // namespace tweenfall::islands
