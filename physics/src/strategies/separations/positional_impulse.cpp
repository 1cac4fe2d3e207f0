#include <tweenfall/curves/rotation.h>

#include "strategies/separations/separations.h"

namespace tweenfall::strategies {

namespace {

/// As an impulse changes a velocity, this changes a position: it is moved at the center of mass, and turned by the
/// arm.
void nudge(Place& place, const Vec3& impulse, const Vec3& arm) {
  place.center += place.inverse_mass * impulse;
  place.rotation = (exp_map(place.inverse_inertia * arm.cross(impulse)) * place.rotation).normalized();
}

}  // namespace

/// The equation of collisions with overlap in place of speed, point by point: bodies turn out of each other, too.
/// What an earlier point has already removed is left out.
void positional_impulse(Overlap& overlap) {
  const Vec3 center_a = overlap.a.center, center_b = overlap.b.center;
  const Quat rotation_a = overlap.a.rotation, rotation_b = overlap.b.rotation;
  for (int i = 0; i < overlap.count; ++i) {
    const Overlap::Point& point = overlap.points[static_cast<std::size_t>(i)];
    const Vec3 arm_a = overlap.a.rotation * (rotation_a.conjugate() * point.arm_a);
    const Vec3 arm_b = overlap.b.rotation * (rotation_b.conjugate() * point.arm_b);
    const Vec3 moved_a = overlap.a.center + arm_a - center_a - point.arm_a;
    const Vec3 moved_b = overlap.b.center + arm_b - center_b - point.arm_b;
    const double left = point.depth - overlap.normal.dot(moved_b - moved_a);
    if (!(left > 0)) continue;
    const Vec3 turn_a = arm_a.cross(overlap.normal), turn_b = arm_b.cross(overlap.normal);
    const double ease = overlap.a.inverse_mass + overlap.b.inverse_mass +
                        turn_a.dot(overlap.a.inverse_inertia * turn_a) + turn_b.dot(overlap.b.inverse_inertia * turn_b);
    const Vec3 impulse = left / ease * overlap.normal;
    nudge(overlap.a, -impulse, arm_a);
    nudge(overlap.b, impulse, arm_b);
  }
}

}  // namespace tweenfall::strategies
