#pragma once

#include "forces/free_flight.h"

namespace tweenfall::pairs {

/// The box that a body cannot leave within a step of `dt` when nothing touches it, enlarged by `room`. Not for
/// planes.
[[nodiscard]] Bounds swept_bounds(const state::Body& body, const forces::Load& load, double room, double dt);

/// How far it travels in that time, to predict what comes after the step.
[[nodiscard]] Vec3 travel(const state::Body& body, const forces::Load& load, double dt);

}  // namespace tweenfall::pairs
