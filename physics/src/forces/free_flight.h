#pragma once

#include <optional>

#include "state/body.h"

namespace tweenfall::forces {

/// What acts on one body during a step, besides contacts.
struct Load {
  Vec3 acceleration{0, 0, 0};      ///< at the start of the step, m/s^2
  Vec3 end_acceleration{0, 0, 0};  ///< the same where the body would be at its end
  Vec3 carried{0, 0, 0};           ///< the part of both that comes from the drag of moving media
  Vec3 torque{0, 0, 0};            ///< N m
  double drag = 0;                 ///< 1/s, taken implicitly
  double angular_drag = 0;         ///< kg m^2/s, taken implicitly
  double angular_damping = 0;      ///< 1/s, taken implicitly
  double springiness = 0;          ///< of the springs on it: k h^2 + c h over the mass that their ends feel
  // Of an integrator that takes what resists by itself, which is in none of those then: what there was of it
  double met_drag = 0;          ///< 1/s
  double met_angular_drag = 0;  ///< kg m^2/s
  bool saturated = false;       ///< so that the drive is at its limit
  Twist pulled;                 ///< of a driven body: with which it gets through the step if nothing touches it
};

struct Spin {
  Quat rotation;
  Vec3 angular;  ///< rad/s, world axes
};

/// Turns a body that nothing touches, to fourth order: momentum and turn are computed in its own axes, and its angular
/// momentum in the world changes by exactly torque times time.
/// Source: Munthe-Kaas, High order Runge-Kutta methods on manifolds, Applied Numerical Mathematics 29, 1999.
[[nodiscard]] Spin turned(const state::Body& body, const Spin& start, const Load& load, double dt);

/// Angular acceleration of a body by Euler's equations, rad/s^2. All in the body's axes; `torque` in N m.
[[nodiscard]] inline Vec3 rate_of_spin(const state::Body& body, const Vec3& torque, const Vec3& angular) {
  const Mat3 &inertia = body.mass().inertia, &inverse = body.inverse_inertia();
  if (!body.aligned()) return inverse * (torque - angular.cross(inertia * angular));
  return inverse.diagonal().cwiseProduct(torque - angular.cross(inertia.diagonal().cwiseProduct(angular)));
}

/// The axis of a symmetric top: the moments about all axes perpendicular to it are equal, and no product of inertia is
/// left. None for other bodies.
[[nodiscard]] std::optional<int> axis_of_top(const Mat3& inertia);

/// The angular velocity of a top after `dt` seconds without torque, body axes: the part along its axis stays, and the
/// rest goes around it evenly. Source: Goldstein, Poole, Safko, Classical Mechanics, 2002, section 5.6.
[[nodiscard]] Vec3 spin_of_top(const Mat3& inertia, int axis, const Vec3& angular, double dt);

/// An angular velocity, reduced so that its energy is at most `most` joules: inertia in world axes turns with its
/// body, so that a spin which is kept through a large turn may gain energy.
[[nodiscard]] Vec3 bounded_spin(const Mat3& inertia, double most, const Vec3& angular);

/// Linear velocity after `dt` under the load alone.
[[nodiscard]] Vec3 accelerated(const Vec3& velocity, const Load& load, Integrator integrator, double dt);

/// Moves a body that nothing touches in the step.
void fly(state::Body& body, const Load& load, Integrator integrator, double dt);

}  // namespace tweenfall::forces
