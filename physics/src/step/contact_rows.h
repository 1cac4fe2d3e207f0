#pragma once

/// Rows of the contact solver: each changes the velocities of two bodies by one impulse.

#include "step/contact_constraint.h"
#include "step/solver.h"

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

/// What a unit of speed along `direction` takes, kg.
[[nodiscard]] double mass_along(const SolverBody& a, const SolverBody& b, const PointConstraint& point,
                                const Vec3& direction);

/// Friction of one point on the circular cone: the impulse that stops the slip, or, when the cone is too narrow, a
/// step along the slip brought back to the cone's edge, so that in the end friction opposes the slip exactly.
/// @return the change of velocity, m/s
double solve_friction(SolverBody& a, SolverBody& b, PointConstraint& point, Vec3& impulse, double limit,
                      const Vec3& normal);

/// Resistance to rolling and spinning: a torque against the relative spin, at most `limit`.
void solve_rolling(SolverBody& a, SolverBody& b, Vec3& impulse, double limit);

/// Step of one normal row toward relative speed `wanted`, total impulse not negative.
/// @return the change of velocity, m/s
double solve_normal(SolverBody& a, SolverBody& b, const PointConstraint& point, double& impulse, double wanted,
                    const Vec3& normal, double firm = 1, double giving = 0);

}  // namespace tweenfall::step
