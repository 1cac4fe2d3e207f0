#include "step/contact_rows.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace tweenfall::step {

Tangents tangents_of(const Vec3& normal) {
  const Vec3 helper = std::abs(normal.x()) < 0.57 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  Tangents tangents;
  tangents.first = normal.cross(helper);
  tangents.first.normalize();
  tangents.second = normal.cross(tangents.first);
  return tangents;
}

void PointRows::prepare(const SolverBody& a, const SolverBody& b, const SolvedPoint& point, const Vec3& normal,
                        const Tangents* tangents) {
  const double inverse_mass = a.inverse_mass + b.inverse_mass;
  turn_a = point.arm_a.cross(normal);
  turn_b = point.arm_b.cross(normal);
  spin_a = a.inverse_inertia * turn_a;
  spin_b = b.inverse_inertia * turn_b;
  const double inverse = inverse_mass + turn_a.dot(spin_a) + turn_b.dot(spin_b);
  mass = inverse > 0 ? 1 / inverse : 0;
  scale = inverse > 0 ? std::sqrt(inverse) : 1;
  stiffest = 0;
  if (!tangents) return;
  along = *tangents;
  drifts = false;
  drift1 = drift2 = later_drift1 = later_drift2 = 0;
  if (a.conveys || b.conveys) {
    const Vec3 drift = drift_at(a.surface, point.arm_a, b.surface, point.arm_b);
    drift_by(drift, drift);
  }
  turn_a1 = point.arm_a.cross(along.first);
  turn_a2 = point.arm_a.cross(along.second);
  turn_b1 = point.arm_b.cross(along.first);
  turn_b2 = point.arm_b.cross(along.second);
  spin_a1 = a.inverse_inertia * turn_a1;
  spin_a2 = a.inverse_inertia * turn_a2;
  spin_b1 = b.inverse_inertia * turn_b1;
  spin_b2 = b.inverse_inertia * turn_b2;
  const double k11 = inverse_mass + turn_a1.dot(spin_a1) + turn_b1.dot(spin_b1);
  const double k22 = inverse_mass + turn_a2.dot(spin_a2) + turn_b2.dot(spin_b2);
  const double k12 = turn_a1.dot(spin_a2) + turn_b1.dot(spin_b2);
  const double determinant = k11 * k22 - k12 * k12;
  if (!(determinant > 0)) return;
  inverse11 = k22 / determinant;
  inverse12 = -k12 / determinant;
  inverse22 = k11 / determinant;
  stiffest = 0.5 * (k11 + k22) + std::sqrt(0.25 * (k11 - k22) * (k11 - k22) + k12 * k12);
}

void PointRows::drift_by(const Vec3& moving, const Vec3& after) {
  drifts = true;
  drift1 += along.first.dot(moving);
  drift2 += along.second.dot(moving);
  later_drift1 += along.first.dot(after);
  later_drift2 += along.second.dot(after);
}

double solve_friction(SolverBody& a, SolverBody& b, const PointRows& rows, Vec3& impulse, double limit) {
  if (!(rows.stiffest > 0)) return 0;
  const Vec3 slip = b.linear - a.linear;
  double slip1 = rows.along.first.dot(slip) + rows.turn_b1.dot(b.angular) - rows.turn_a1.dot(a.angular);
  double slip2 = rows.along.second.dot(slip) + rows.turn_b2.dot(b.angular) - rows.turn_a2.dot(a.angular);
  if (rows.drifts) {
    slip1 += rows.drift1;
    slip2 += rows.drift2;
  }
  const double old1 = impulse.dot(rows.along.first), old2 = impulse.dot(rows.along.second);
  double new1 = old1 - (rows.inverse11 * slip1 + rows.inverse12 * slip2);
  double new2 = old2 - (rows.inverse12 * slip1 + rows.inverse22 * slip2);
  if (new1 * new1 + new2 * new2 > limit * limit) {
    new1 = old1 - slip1 / rows.stiffest;
    new2 = old2 - slip2 / rows.stiffest;
    const double length = std::sqrt(new1 * new1 + new2 * new2);
    if (length > limit) {
      new1 *= limit / length;
      new2 *= limit / length;
    }
  }
  const double change1 = new1 - old1, change2 = new2 - old2;
  const Vec3 change = change1 * rows.along.first + change2 * rows.along.second;
  impulse = new1 * rows.along.first + new2 * rows.along.second;
  a.linear -= a.inverse_mass * change;
  a.angular -= change1 * rows.spin_a1 + change2 * rows.spin_a2;
  b.linear += b.inverse_mass * change;
  b.angular += change1 * rows.spin_b1 + change2 * rows.spin_b2;
  return std::max(std::abs(change1), std::abs(change2)) * rows.stiffest;
}

void solve_rolling(SolverBody& a, SolverBody& b, Vec3& impulse, double limit) {
  const Mat3 inverse = a.inverse_inertia + b.inverse_inertia;
  const Vec3 wanted = impulse - inverse.inverse() * (b.angular - a.angular);
  Vec3 next = wanted;
  if (next.norm() > limit) {
    next = impulse - (b.angular - a.angular) / inverse.trace();
    if (next.norm() > limit) next *= limit / next.norm();
  }
  const Vec3 change = next - impulse;
  impulse = next;
  a.angular -= a.inverse_inertia * change;
  b.angular += b.inverse_inertia * change;
}

void solve_spinning(SolverBody& a, SolverBody& b, const Vec3& normal, double& impulse, double limit) {
  const Vec3 turn_a = a.inverse_inertia * normal, turn_b = b.inverse_inertia * normal;
  const double inverse = normal.dot(turn_a + turn_b);
  if (!(inverse > 0)) return;
  const double spin = normal.dot(b.angular + b.surface.angular - a.angular - a.surface.angular);
  const double next = std::clamp(impulse - spin / inverse, -limit, limit);
  const double change = next - impulse;
  impulse = next;
  a.angular -= change * turn_a;
  b.angular += change * turn_b;
}

double solve_normal(SolverBody& a, SolverBody& b, const PointRows& rows, double& impulse, double wanted,
                    const Vec3& normal, double firm) {
  const double speed = normal.dot(b.linear - a.linear) + rows.turn_b.dot(b.angular) - rows.turn_a.dot(a.angular);
  const double next = std::max(0.0, firm * impulse - firm * rows.mass * (speed - wanted));
  const double change = next - impulse;
  impulse = next;
  if (change != 0) {
    a.linear -= a.inverse_mass * change * normal;
    a.angular -= change * rows.spin_a;
    b.linear += b.inverse_mass * change * normal;
    b.angular += change * rows.spin_b;
  }
  return rows.mass > 0 ? std::abs(change) / rows.mass : 0;
}

}  // namespace tweenfall::step
