#pragma once

// Busy worlds, given by what is done to them before each step: for runs that must end in the same bits.

#include <tweenfall/physics/world.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "random.h"
#include "support.h"

namespace tweenfall::test {

struct Scenario {
  std::string name;
  int steps = 0;
  std::function<World()> make;
  std::function<void(World&, int)> step;  ///< what is done before step number n, and the step
};

[[nodiscard]] std::vector<Scenario> scenarios();

/// All solids, hulls too, at random places in a column.
[[nodiscard]] std::vector<BodySettings> mixed_bodies(unsigned seed, int count);

}  // namespace tweenfall::test
