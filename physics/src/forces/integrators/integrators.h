#pragma once

#include <tweenfall/physics/world.h>

#include <functional>
#include <span>
#include <vector>

namespace tweenfall::forces {

/// How a body goes on, apart from contacts: per second, or altogether.
struct Change {
  Vec3 center{0, 0, 0};    ///< of its center of mass
  Vec3 linear{0, 0, 0};    ///< of its velocity
  Vec3 turn{0, 0, 0};      ///< rotation vector, world axes, since the start of the step
  Vec3 momentum{0, 0, 0};  ///< of its angular momentum, world axes

  void add(double share, const Change& other);
};

/// Rates of change of all bodies together, so that what two of them do to each other is equal and opposite, at any
/// states asked for: those in which they are `after` seconds into the step, having changed like this since its start.
using Rates = std::function<void(double after, std::span<const Change> since, std::span<Change> rates)>;

/// Room that an integrator keeps from step to step: one list of all bodies for each thing that it remembers of them.
using Room = std::vector<std::vector<Change>>;

/// An integrator: the mean rates of change over a step.
/// @param means  written; as long as there are bodies
using Integrate = void(const Rates& rates, double dt, Room& room, std::span<Change> means);

// One file each
Integrate explicit_euler, midpoint, trapezoid, rk4;

/// Null for those that know their forces from the start of the step on.
[[nodiscard]] Integrate* asking(Integrator integrator);
[[nodiscard]] bool exists(Integrator integrator);

}  // namespace tweenfall::forces
