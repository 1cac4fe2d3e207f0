#pragma once

#include <vector>

#include "forces/free_flight.h"
#include "state/body.h"

namespace tweenfall {

struct NumberedForce {
  std::size_t number = 0;
  Force force;
};

/// Loads of all bodies for a step of length `dt` that starts at `time`; `loads` is sized like `bodies`.
void gather_loads(const std::vector<Body>& bodies, const std::vector<NumberedForce>& forces,
                  const WorldSettings& settings, double time, double dt, std::vector<Load>& loads);

/// Wakes bodies on a spring whose other end moves, and all bodies when there is a field.
void wake_by_forces(std::vector<Body>& bodies, const std::vector<NumberedForce>& forces);

}  // namespace tweenfall
