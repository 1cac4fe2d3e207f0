#pragma once

#include <vector>

#include "forces/forces.h"
#include "queries/scene.h"
#include "state/body.h"

namespace tweenfall::queries {

[[nodiscard]] const std::vector<state::Body>& bodies_of(const World& world);
[[nodiscard]] const std::vector<forces::NumberedForce>& forces_of(const World& world);

/// A world's bodies, by index.
inline void arrange_bodies(Scene& scene, const std::vector<state::Body>& bodies) {
  scene.arrange(bodies.size(), [&bodies](std::uint32_t index) -> Item {
    const state::Body& body = bodies[index];
    if (!body.alive) return {};
    return {&body.shape(), body.motion.pose, body.generation, body.groups(), body.sensor()};
  });
}

}  // namespace tweenfall::queries
