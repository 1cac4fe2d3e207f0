#pragma once

#include <functional>
#include <span>
#include <vector>

#include "forces/free_flight.h"
#include "islands/island_contents.h"

namespace tweenfall::islands {

/// Between bodies that are led against each other, or that lie in what never gives way, no impulse is enough, and those
/// of each step would add to those of the last for as long as that goes on: a row of boxes in a press would hold
/// thousands of newton seconds, and leave with them as soon as its contacts turn. So where contacts press with more
/// than takes the whole island along, and it is not because something holds, that much is kept of their impulses, and
/// nothing gets faster than what leads, than overlap is taken apart, or than the fastest was before the step.
/// @param start_of  twist of a body before the step, by index
void tame_pinched(const IslandContents& island, std::vector<state::Body>& bodies,
                  const std::vector<forces::Load>& loads, const WorldSettings& settings, double dt,
                  const std::function<const Twist&(std::uint32_t)>& start_of);

/// Whether contacts lie in two or more bodies that never give way, deeper than so many meters.
[[nodiscard]] bool is_wedged(std::span<contacts::ContactConstraint* const> contacts,
                             const std::vector<state::Body>& bodies, double deep);

}  // namespace tweenfall::islands
