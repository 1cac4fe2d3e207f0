#pragma once

#include <tweenfall/physics/world.h>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace tweenfall::forces {

/// Rates of change of all numbers of a state together, at any state: `after` seconds into the step, with
/// the state changed by `since` since its start.
using Rates = std::function<void(double after, std::span<const double> since, std::span<double> rates)>;

/// A state that changes by x' = f(x, t), in blocks of equal size, one per body.
struct Flow {
  Rates rates;
  std::size_t block = 1;                 ///< numbers of one body
  std::size_t kind = 1;                  ///< numbers that form a vector
  std::span<const std::uint8_t> places;  ///< by number of a block: 1 for a position, 0 for a velocity
  std::span<const double> sizes;         ///< by number: its magnitude at the start, or that of the vector it belongs to
  std::span<const std::uint32_t> ties;  ///< by block: one that it is tied to, directly or not, the same for all of them
  std::span<const std::uint32_t> turns;  ///< by block: two that act on each other have different turns
};

/// Memory that an integrator keeps from step to step: one list over all numbers for each quantity it remembers.
using Room = std::vector<std::vector<double>>;

/// An integrator: the mean rates of change over a step.
/// @param means  written; as long as the state
using Integrate = void(const Flow& flow, double dt, Room& room, std::span<double> means);

// One file each
Integrate explicit_euler, semi_implicit_euler, midpoint, trapezoid, rk4, verlet, backward_euler, implicit_trapezoid;

/// The function for any flow; for the default integrator it is Verlet's.
[[nodiscard]] Integrate* integrator_of(Integrator integrator);
/// The function that evaluates forces at states of its own choosing; null for integrators that know them from the start
/// of the step.
[[nodiscard]] Integrate* asking(Integrator integrator);
/// Whether it takes springs of any stiffness.
[[nodiscard]] bool implicit(Integrator integrator);
[[nodiscard]] bool exists(Integrator integrator);

/// The change of the state after `share` seconds at these rates.
void advance(std::span<double> since, double share, std::span<const double> rates);

}  // namespace tweenfall::forces
