#pragma once

#include <span>
#include <vector>

#include "forces/free_flight.h"
#include "state/body.h"
#include "step/spring_row.h"
#include "threads/workers.h"

namespace tweenfall::forces {

class Flight;

struct NumberedForce {
  std::uint64_t number = 0;
  Force force;
};

/// Loads of the watched bodies for a step of length `dt` that starts at `time`; `loads` becomes as long as `bodies`.
/// Springs that are too stiff for the step go into `stiff` and into no load. An integrator that asks for forces where
/// it wants them leaves in `flight` where bodies get that nothing touches.
void gather_loads(const std::vector<state::Body>& bodies, std::span<const std::uint32_t> watched,
                  const std::vector<NumberedForce>& forces, const WorldSettings& settings, double time, double dt,
                  const threads::Workers& workers, std::vector<Load>& loads, std::vector<step::SpringRow>& stiff,
                  Flight& flight);

/// By the springiness in the loads: whether a spring is a row among the contacts instead.
[[nodiscard]] bool too_stiff(const Spring& spring, const std::vector<state::Body>& bodies,
                             const std::vector<Load>& loads);

/// The body of a handle; null when it is gone, or for the world itself.
[[nodiscard]] const state::Body* find_body(const std::vector<state::Body>& bodies, const BodyId& id);

}  // namespace tweenfall::forces
