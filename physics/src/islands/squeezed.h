#pragma once

#include <functional>
#include <vector>

#include "forces/free_flight.h"
#include "islands/island_contents.h"

namespace tweenfall::islands {

/// What bodies that are led squeeze out between them gets the faster, the more they face each other, and without any
/// bound in the limit: a ball of 1 kg between two others that close with 1 m/s has left them with 30. Whatever gets
/// more than three times as fast as what leads it, though it has its energy from nothing else, is marked as squeezed;
/// and no body gets more than ten times as fast.
/// @param slowest  taken for the speed of what is led more slowly, m/s
/// @param start_of  twist of a body before the step, by index
void bound_squeezed(const IslandContents& island, std::vector<state::Body>& bodies,
                    const std::vector<forces::Load>& loads, double slowest, double dt,
                    const std::function<const Twist&(std::uint32_t)>& start_of);

}  // namespace tweenfall::islands
