#pragma once

/// A stretch of particles while an integrator takes them through a step.

#include <tweenfall/physics/particles.h>

#include <array>
#include <span>
#include <vector>

namespace tweenfall::particles {

/// Particles that are worked on together: as many as stay in a processor's nearest memory.
inline constexpr std::size_t most_together = 256;

/// Three numbers for each of some particles.
using Lists = std::array<std::array<double, most_together>, 3>;

/// What acts on some particles at one state of theirs.
struct Pulls {
  Lists acceleration;                      ///< m/s^2, with what media carry along and without their drag
  Lists carried;                           ///< of that, what media carry along
  std::array<double, most_together> drag;  ///< 1/s
  bool drags = false, carries = false;     ///< whether any does
};

struct PullingForce {
  const Force* force;
  double start, middle, end;  ///< strength through the step
};

/// All that acts on particles through a step.
struct Pulling {
  Vec3 gravity;
  double mass, radius;
  std::span<const PullingForce> forces;
  bool steady = true;  ///< none depends on a place or the time
};

enum class Instant { start, middle, end };

/// What acts on `count` particles at a state.
void find_pulls(const Pulling& pulling, std::size_t count, const Lists& places, const Lists& speeds, double time,
                Instant instant, Pulls& pulls);

/// Takes `count` particles through `dt` seconds.
void integrate(Integrator integrator, const Pulling& pulling, std::size_t count, double time, double dt, Lists& places,
               Lists& speeds);
/// Whether it does.
[[nodiscard]] bool integrates(Integrator integrator);

/// Whether it is a kind that acts on particles.
[[nodiscard]] bool acts_on_particles(const Force& force);
/// Whether what it does is the same everywhere and at all times.
[[nodiscard]] bool is_steady(const Force& force);

}  // namespace tweenfall::particles
