#pragma once

// What tests of soft bodies share.

#include "support.h"

#include <tweenfall/physics/soft_body.h>

namespace tweenfall::test {

/// Total momentum of a soft body, kg m/s.
inline Vec3 momentum_of(const World& world, SoftId id) {
  Vec3 sum(0, 0, 0);
  const auto velocities = soft_velocities(world, id);
  for (std::size_t i = 0; i < velocities.size(); ++i) sum += soft_settings(world, id).masses[i] * velocities[i];
  return sum;
}

/// Its center of mass, m.
inline Vec3 center_of(const World& world, SoftId id) {
  Vec3 sum(0, 0, 0);
  double mass = 0;
  const auto places = soft_positions(world, id);
  for (std::size_t i = 0; i < places.size(); ++i) {
    sum += soft_settings(world, id).masses[i] * places[i];
    mass += soft_settings(world, id).masses[i];
  }
  return sum / mass;
}

inline double energy_of(const World& world, SoftId id) {
  const SoftEnergy energy = soft_energy(world, id);
  return energy.kinetic + energy.elastic + energy.weight;
}

inline bool all_finite(const World& world, SoftId id) {
  const auto finite = [](const Vec3& value) { return value.allFinite(); };
  return std::ranges::all_of(soft_positions(world, id), finite) &&
         std::ranges::all_of(soft_velocities(world, id), finite);
}

inline void step(World& world, double seconds, double dt = 1.0 / 240) {
  for (double n = std::round(seconds / dt); n > 0; --n) world.step(dt);
}

}  // namespace tweenfall::test
