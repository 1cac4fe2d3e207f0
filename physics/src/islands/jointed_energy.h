#pragma once

#include <functional>
#include <vector>

#include "islands/free_islands.h"
#include "islands/island_contents.h"

namespace tweenfall::islands {

/// Whether a motor or a spring of it may give energy to the bodies that a joint holds.
[[nodiscard]] bool gives_energy(const JointKind& kind);

/// Relative gain of energy in a step that passes for an error of the step.
inline constexpr double passable_gain = 0.01;

/// Jointed bodies that something immovable holds or bears: blows that joints hand on to much lighter bodies leave them
/// with more energy than they had and were given. All of them slow down together, so that their joints hold, until
/// they have gained no more than passes for an error.
/// @param moved  by index: set for the bodies that the solver moved
void bound_jointed(const IslandContents& island, std::vector<state::Body>& bodies,
                   const std::vector<forces::Load>& loads, const std::vector<char>& moved,
                   const std::function<FreeStart(std::uint32_t)>& start_of);

}  // namespace tweenfall::islands
