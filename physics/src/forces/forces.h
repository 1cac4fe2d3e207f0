#pragma once

#include <optional>
#include <span>
#include <vector>

#include "forces/free_flight.h"
#include "forces/kinds/kinds.h"
#include "state/body.h"
#include "step/spring_row.h"
#include "threads/workers.h"

namespace tweenfall::forces {

class Flight;

struct NumberedForce {
  std::uint64_t number = 0;
  Force force;
  ForceSettings settings;
};

/// Loads of the watched bodies for a step of length `dt` that starts at `time`; `loads` becomes as long as `bodies`.
/// Springs that are too stiff for the step go into `stiff` and into no load. An integrator that evaluates forces at
/// states of its own writes to `flight` where bodies get that nothing touches.
void gather_loads(const std::vector<state::Body>& bodies, std::span<const std::uint32_t> watched,
                  const std::vector<NumberedForce>& forces, const WorldSettings& settings, double time, double dt,
                  const threads::Workers& workers, std::vector<Load>& loads, std::vector<step::SpringRow>& stiff,
                  Flight& flight);

/// Whether a spring is too stiff for the step, by the springiness in the loads, and becomes a row among the contacts.
[[nodiscard]] bool too_stiff(const Spring& spring, const std::vector<state::Body>& bodies,
                             const std::vector<Load>& loads);

/// The body of a handle; null if it was removed, or for the world itself.
[[nodiscard]] const state::Body* find_body(const std::vector<state::Body>& bodies, const BodyId& id);

/// A force between two points at this strength, if both its ends exist; empty for all other forces.
[[nodiscard]] std::optional<Spring> spring_between(const Force& force, double strength,
                                                   const std::vector<state::Body>& bodies);
[[nodiscard]] Effect effect_of(const Force& force, double strength, const Subject& subject, const Moment& moment);
[[nodiscard]] Named named(const Force& force);

/// Calls `see(index)` for each existing body that a force acts on by itself, in order.
/// @param all  indices of existing bodies, in order: a force without a list of its own acts on all of them
template <class Indices, class See>
void each_acted(const NumberedForce& entry, const std::vector<state::Body>& bodies, const Indices& all,
                const See& see) {
  const Named own = named(entry.force);
  const auto see_one = [&](const BodyId& id) {
    if (find_body(bodies, id)) see(id.index);
  };
  if (own.alone) {
    for (const BodyId& end : own.ends) see_one(end);
  } else if (!entry.settings.bodies.empty()) {
    for (const BodyId& id : entry.settings.bodies)
      if (id != own.ends[0]) see_one(id);
  } else {
    for (const std::uint32_t i : all)
      if (i != own.ends[0].index) see(i);
  }
}

/// Calls `see(a, b)` for each pair of bodies of which one acts on the other.
template <class Indices, class See>
void each_tie(const NumberedForce& entry, const std::vector<state::Body>& bodies, const Indices& all, const See& see) {
  const Named own = named(entry.force);
  const BodyId &a = own.ends[0], &b = own.ends[1];
  if (own.alone) {
    if (find_body(bodies, a) && find_body(bodies, b)) see(a.index, b.index);
  } else if (find_body(bodies, a)) {
    each_acted(entry, bodies, all, [&](std::uint32_t i) { see(a.index, i); });
  }
}

/// Whether a force may change from one time to the other although its bodies rest.
[[nodiscard]] bool stirs(const NumberedForce& entry, double from, double to);

}  // namespace tweenfall::forces
