#pragma once

#include "forces/forces.h"

namespace tweenfall::forces {

/// How fast what a force does to a body changes with the body's own motion: what steps have to follow.
struct Pace {
  double damping = 0;  ///< by its velocity or its spin, 1/s
  double swing = 0;    ///< by its place, rad/s
};

/// @param linear  velocity for which it is asked, m/s
/// @param resistance  whether what resists counts: not for integrators that take it as it is at the end of the step
[[nodiscard]] Pace pace_of(const NumberedForce& force, const state::Body& body, const Vec3& linear,
                           const Moment& moment, bool resistance);

/// Speed at which what resists in a force bears the weight of a body that falls, m/s; infinity beyond a million.
[[nodiscard]] double falling_speed(const NumberedForce& force, const state::Body& body, const Moment& moment);

}  // namespace tweenfall::forces
