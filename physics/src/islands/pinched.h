#pragma once

#include <functional>
#include <span>
#include <vector>

#include "forces/free_flight.h"
#include "islands/island_contents.h"

namespace tweenfall::islands {

/// Between bodies that are led against each other, or for a body stuck in immovable ones, no impulse is enough, and
/// those of each step would add to those of the last for as long as that lasts: a row of boxes in a press would store
/// thousands of newton seconds, and fly off with them as soon as its contacts turn. So if contacts press with more
/// than moves the whole island along, and not because something holds it, only that much of their impulses is kept, and
/// no body gets faster than what leads it, than overlap is removed, or than the fastest was before the step.
/// @param start_of  twist of a body before the step, by index
void tame_pinched(const IslandContents& island, std::vector<state::Body>& bodies,
                  const std::vector<forces::Load>& loads, const WorldSettings& settings, double dt,
                  const std::function<const Twist&(std::uint32_t)>& start_of);

/// Whether contacts with two or more immovable bodies are deeper than `deep` meters.
[[nodiscard]] bool is_wedged(std::span<contacts::ContactConstraint* const> contacts,
                             const std::vector<state::Body>& bodies, double deep);

}  // namespace tweenfall::islands
