#pragma once

/// Rows of the contact solver: each changes the velocities of two bodies by one impulse.

#include "step/solved_contact.h"
#include "step/solver_body.h"

namespace tweenfall::step {

[[nodiscard]] inline Vec3 point_velocity(const SolverBody& body, const Vec3& arm) {
  return body.linear + body.angular.cross(arm);
}

inline void push(SolverBody& body, const Vec3& impulse, const Vec3& arm) {
  body.linear += body.inverse_mass * impulse;
  body.angular += body.inverse_inertia * arm.cross(impulse);
}

/// Two unit vectors across a normal and each other.
struct Tangents {
  Vec3 first, second;
};
[[nodiscard]] Tangents tangents_of(const Vec3& normal);

/// One point's rows along its normal and across it, for the positions of the bodies in a sub-step.
struct PointRows {
  Vec3 turn_a, turn_b;  ///< arm x normal
  Vec3 spin_a, spin_b;  ///< angular velocity per unit of impulse along the normal
  double mass = 0;      ///< impulse along the normal per unit of speed, kg
  double scale = 1;     ///< makes impulses of different masses comparable: square root of the speed per unit of impulse
  double firm = 1;      ///< share of the speed error along the normal that one pass removes while the contact is soft

  // Across the normal; only with friction
  Tangents along;
  Vec3 turn_a1, turn_a2, turn_b1, turn_b2, spin_a1, spin_a2, spin_b1, spin_b2;
  double inverse11 = 0, inverse12 = 0, inverse22 = 0;  ///< from the slip to the impulse that stops it
  double drift1 = 0, drift2 = 0;  ///< speed of b's surface against a's, in addition to the bodies' motion, m/s
  double later_drift1 = 0, later_drift2 = 0;  ///< the same once the bodies have been moved
  bool drifts = false;
  double stiffest = 0;  ///< the greatest speed that a unit of impulse makes, 1/kg

  void prepare(const SolverBody& a, const SolverBody& b, const SolvedPoint& point, const Vec3& normal,
               const Tangents* tangents);
  /// What is added to the slip: while bodies are moved, and afterwards.
  void drift_by(const Vec3& moving, const Vec3& after);
};

/// Friction of one point on the circular cone: the impulse that stops the slip, or, when the cone is too narrow, a
/// step along the slip projected back onto the cone, so that in the end friction opposes the slip exactly.
/// @return the change of velocity, m/s
double solve_friction(SolverBody& a, SolverBody& b, const PointRows& rows, Vec3& impulse, double limit);

/// Resistance to rolling and spinning: a torque against the relative spin, at most `limit`.
void solve_rolling(SolverBody& a, SolverBody& b, Vec3& impulse, double limit);

/// Resistance to spinning: a torque about the normal against the spin of b's surface against a's, at most `limit`.
void solve_spinning(SolverBody& a, SolverBody& b, const Vec3& normal, double& impulse, double limit);

/// Velocity of b's surface against a's at a contact, in addition to the motion of the bodies, m/s.
[[nodiscard]] inline Vec3 drift_at(const Twist& a, const Vec3& arm_a, const Twist& b, const Vec3& arm_b) {
  return b.linear + b.angular.cross(arm_b) - a.linear - a.angular.cross(arm_a);
}

/// One step of a normal row toward the relative speed `wanted`; the total impulse stays >= 0.
/// @param firm  share of the speed error that is removed, and of the impulse that is kept
/// @return the change of velocity, m/s
double solve_normal(SolverBody& a, SolverBody& b, const PointRows& rows, double& impulse, double wanted,
                    const Vec3& normal, double firm = 1);

}  // namespace tweenfall::step
