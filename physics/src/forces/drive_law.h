#pragma once

#include "forces/free_flight.h"

namespace tweenfall::forces {

/// The pull of a driven body as an implicit change of velocity per unit mass:
/// v' = (v + gain * wanted) / (1 + stiffness), so that v' is the velocity with the spring and damper evaluated at the
/// end of the step. Source: Catto, Soft Constraints, GDC 2011.
struct DriveLaw {
  double stiffness = 0;   ///< 2 z w h + w^2 h^2
  Vec3 linear{0, 0, 0};   ///< h (w^2 (x_t - x) + 2 z w v_t), m/s
  Vec3 angular{0, 0, 0};  ///< the same for rotation, rad/s
};

/// @param target_ahead  time from the end of this (sub-)step to the target's, s; its twist moves the target back by it
[[nodiscard]] DriveLaw drive_law(const state::Body& body, const Vec3& center, const Quat& rotation, double h,
                                 double target_ahead);

/// Velocity of a driven body at the end of a step in which nothing touches it; it moves by this velocity, too.
/// @param saturated  written: whether its greatest force or torque is too small
[[nodiscard]] Twist pulled(const state::Body& body, const Load& load, Integrator integrator, double dt,
                           bool& saturated);

/// Moves a driven body that nothing touches.
void pull(state::Body& body, const Load& load, double dt);

}  // namespace tweenfall::forces
