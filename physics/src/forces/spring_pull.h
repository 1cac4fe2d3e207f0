#pragma once

#include "state/body.h"

namespace tweenfall::forces {

/// A body as the forces see it: now, or where it would be.
struct Glimpse {
  Vec3 center, linear, angular;
  Quat rotation;
};

[[nodiscard]] Glimpse now(const state::Body& body);

/// Force of a spring on its first end, and the arms to both ends.
struct Pull {
  Vec3 force, arm_a, arm_b;
};

/// @param body_b  null for the world
[[nodiscard]] Pull pull_of(const Spring& spring, const state::Body& body_a, const Glimpse& a, const state::Body* body_b,
                           const Glimpse& b);

}  // namespace tweenfall::forces
