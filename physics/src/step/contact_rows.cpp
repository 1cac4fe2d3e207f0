#include "step/contact_rows.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace tweenfall::step {

double mass_along(const SolverBody& a, const SolverBody& b, const PointConstraint& point, const Vec3& direction) {
  const Vec3 turn_a = point.arm_a.cross(direction);
  const Vec3 turn_b = point.arm_b.cross(direction);
  const double inverse =
      a.inverse_mass + b.inverse_mass + turn_a.dot(a.inverse_inertia * turn_a) + turn_b.dot(b.inverse_inertia * turn_b);
  return inverse > 0 ? 1 / inverse : 0;
}

Tangents tangents_of(const Vec3& normal) {
  const Vec3 helper = std::abs(normal.x()) < 0.57 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  Tangents tangents;
  tangents.first = normal.cross(helper);
  tangents.first.normalize();
  tangents.second = normal.cross(tangents.first);
  return tangents;
}

double solve_friction(SolverBody& a, SolverBody& b, PointConstraint& point, Vec3& impulse, double limit,
                      const Vec3& normal) {
  const Tangents along = tangents_of(normal);
  const Vec3 slip = point_velocity(b, point.arm_b) - point_velocity(a, point.arm_a);
  const double slip1 = slip.dot(along.first);
  const double slip2 = slip.dot(along.second);
  const Vec3 a1 = point.arm_a.cross(along.first), a2 = point.arm_a.cross(along.second);
  const Vec3 b1 = point.arm_b.cross(along.first), b2 = point.arm_b.cross(along.second);
  const double inverse_mass = a.inverse_mass + b.inverse_mass;
  const Vec3 ia1 = a.inverse_inertia * a1, ia2 = a.inverse_inertia * a2;
  const Vec3 ib1 = b.inverse_inertia * b1, ib2 = b.inverse_inertia * b2;
  const double k11 = inverse_mass + a1.dot(ia1) + b1.dot(ib1);
  const double k22 = inverse_mass + a2.dot(ia2) + b2.dot(ib2);
  const double k12 = a1.dot(ia2) + b1.dot(ib2);
  const double determinant = k11 * k22 - k12 * k12;
  if (!(determinant > 0)) return 0;
  const double old1 = impulse.dot(along.first), old2 = impulse.dot(along.second);
  double new1 = old1 - (k22 * slip1 - k12 * slip2) / determinant;
  double new2 = old2 - (k11 * slip2 - k12 * slip1) / determinant;
  if (new1 * new1 + new2 * new2 > limit * limit) {
    const double largest = 0.5 * (k11 + k22) + std::sqrt(0.25 * (k11 - k22) * (k11 - k22) + k12 * k12);
    new1 = old1 - slip1 / largest;
    new2 = old2 - slip2 / largest;
    const double length = std::sqrt(new1 * new1 + new2 * new2);
    if (length > limit) {
      new1 *= limit / length;
      new2 *= limit / length;
    }
  }
  const Vec3 change = (new1 - old1) * along.first + (new2 - old2) * along.second;
  impulse = new1 * along.first + new2 * along.second;
  push(a, -change, point.arm_a);
  push(b, change, point.arm_b);
  return std::max(std::abs(new1 - old1), std::abs(new2 - old2)) * std::max(k11, k22);
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

double solve_normal(SolverBody& a, SolverBody& b, const PointConstraint& point, double& impulse, double wanted,
                    const Vec3& normal, double firm, double giving) {
  const double speed = normal.dot(point_velocity(b, point.arm_b) - point_velocity(a, point.arm_a));
  const double next = std::max(0.0, (1 - giving) * impulse - firm * point.normal_mass * (speed - wanted));
  const double change = next - impulse;
  impulse = next;
  if (change != 0) {
    push(a, -change * normal, point.arm_a);
    push(b, change * normal, point.arm_b);
  }
  return point.normal_mass > 0 ? std::abs(change) / point.normal_mass : 0;
}

}  // namespace tweenfall::step
