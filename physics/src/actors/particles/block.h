#pragma once

/// A block of particles that an integrator moves through a step.

#include <tweenfall/physics/particles.h>

#include <array>
#include <span>
#include <vector>

namespace tweenfall::particles {

/// Particles that are handled together: as many as fit into a processor's nearest cache.
inline constexpr std::size_t most_together = 256;

/// Three numbers per particle.
using Lists = std::array<std::array<double, most_together>, 3>;

/// What acts on some particles at one of their states.
struct Pulls {
  Lists acceleration;                      ///< m/s^2, including what media carry along, but without their drag
  Lists carried;                           ///< the part of it that media carry along
  std::array<double, most_together> drag;  ///< 1/s
  bool drags = false, carries = false;     ///< whether any does
};

struct PullingForce {
  const Force* force;
  double start, middle, end;  ///< strength through the step
};

/// Everything that acts on particles through a step.
struct Pulling {
  Vec3 gravity;
  double mass, radius;
  std::span<const PullingForce> forces;
  bool steady = true;  ///< none depends on a position or the time
};

enum class Instant { start, middle, end };

/// Computes what acts on `count` particles at a state.
void find_pulls(const Pulling& pulling, std::size_t count, const Lists& places, const Lists& speeds, double time,
                Instant instant, Pulls& pulls);

/// Accelerations that include all drag.
void accelerate(const Pulling& pulling, std::size_t count, const Lists& places, const Lists& speeds, double time,
                Instant instant, Pulls& pulls, Lists& out);

/// Moves `count` particles through `dt` seconds.
void integrate(Integrator integrator, const Pulling& pulling, std::size_t count, double time, double dt, Lists& places,
               Lists& speeds);
/// The same by mean rates to which those at the end, where they themselves lead, contribute `share`: 1 for backward
/// Euler, 1/2 for the implicit trapezoid. Each particle alone: of a linear force the first step of Newton's method is
/// the closed form. If there is no solution, the nearest approach is taken.
/// Source: Hairer and Wanner, Solving Ordinary Differential Equations II, IV.8.
void meet_the_end(const Pulling& pulling, std::size_t count, double time, double dt, double share, Lists& places,
                  Lists& speeds);

/// Whether a force is of a kind that acts on particles.
[[nodiscard]] bool acts_on_particles(const Force& force);
/// Whether its effect is the same everywhere and at all times.
[[nodiscard]] bool is_steady(const Force& force);

}  // namespace tweenfall::particles
