#pragma once

#include <tweenfall/physics/world.h>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace tweenfall::forces {

/// Rates of change of all numbers of a state together, at any states asked for: those in which they are `after` seconds
/// into the step, having changed by `since` since its start.
using Rates = std::function<void(double after, std::span<const double> since, std::span<double> rates)>;

/// A state that changes by x' = f(x, t), in blocks of so many numbers, one for each body.
struct Flow {
  Rates rates;
  std::size_t block = 1;                 ///< numbers of one body
  std::size_t kind = 1;                  ///< numbers that make a vector
  std::span<const std::uint8_t> places;  ///< by number of a block: 1 for a place, 0 for a speed
  std::span<const double> sizes;         ///< by number: how great it is at the start, or the vector that it is of
  std::span<const std::uint32_t> ties;   ///< by block: one that it is tied to by any way, for all of them the same
  std::span<const std::uint32_t> turns;  ///< by block: of two that act on each other each has another
};

/// Room that an integrator keeps from step to step: one list of all numbers for each thing that it remembers of them.
using Room = std::vector<std::vector<double>>;

/// An integrator: the mean rates of change over a step.
/// @param means  written; as long as the state
using Integrate = void(const Flow& flow, double dt, Room& room, std::span<double> means);

// One file each
Integrate explicit_euler, semi_implicit_euler, midpoint, trapezoid, rk4, verlet, backward_euler, implicit_trapezoid;

/// The one that takes any flow by the name; that of the usual one is Verlet's.
[[nodiscard]] Integrate* integrator_of(Integrator integrator);
/// The one that asks for forces at states of its own choosing; null for those that know them from the start of the step
/// on.
[[nodiscard]] Integrate* asking(Integrator integrator);
/// Whether it takes springs of any stiffness.
[[nodiscard]] bool implicit(Integrator integrator);
[[nodiscard]] bool exists(Integrator integrator);

/// By how much the state has changed, `share` of a rate long.
void advance(std::span<double> since, double share, std::span<const double> rates);

}  // namespace tweenfall::forces
