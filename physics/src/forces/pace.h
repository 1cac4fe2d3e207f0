#pragma once

#include "forces/forces.h"

namespace tweenfall::forces {

/// How fast the effect of a force on a body changes with the body's own motion, which steps have to follow.
struct Pace {
  double damping = 0;  ///< with its velocity or its spin, 1/s
  double swing = 0;    ///< with its position, rad/s
};

/// @param linear  velocity at which it is evaluated, m/s
/// @param resistance  whether resistance counts: not for integrators that take it as it is at the end of the step
[[nodiscard]] Pace pace_of(const NumberedForce& force, const state::Body& body, const Vec3& linear,
                           const Moment& moment, bool resistance);

/// Speed at which the resistance in a force carries the weight of a falling body, m/s; infinity beyond a million.
[[nodiscard]] double falling_speed(const NumberedForce& force, const state::Body& body, const Moment& moment);

}  // namespace tweenfall::forces
