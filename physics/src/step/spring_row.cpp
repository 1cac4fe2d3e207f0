#include "step/spring_row.h"

#include <Eigen/LU>
#include <algorithm>

#include "step/contact_rows.h"

namespace tweenfall::step {

namespace {

Mat3 inverse_mass_at(const SolverBody& body, const Vec3& arm) {
  Mat3 cross;
  cross << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
  return body.inverse_mass * Mat3::Identity() - cross * body.inverse_inertia * cross;
}

}  // namespace

void SpringRow::begin(SolverBody* body_a, SolverBody* body_b, double h) {
  arm_a = body_a->rotation * local_a;
  arm_b = body_b ? Vec3(body_b->rotation * local_b) : Vec3(0, 0, 0);
  const Vec3 end_b = body_b ? Vec3(body_b->center + arm_b) : local_b;
  const Vec3 between = end_b - (body_a->center + arm_a);
  const double length = between.norm();
  const Vec3 direction = length > 0 ? Vec3(between / length) : Vec3(0, 0, 0);
  pull = h * stiffness * (length - rest_length) * direction;
  if (rest_length == 0) pull = h * stiffness * between;
  // Only the part that pulls toward the line of the spring: a force that turns away from it would not be stable.
  const double across = rest_length == 0       ? stiffness
                        : length > rest_length ? stiffness * (1 - rest_length / length)
                                               : 0;
  const Mat3 along = direction * direction.transpose();
  give = h * ((h * (stiffness - across) + damping) * along + h * across * Mat3::Identity());
  inverse_mass = inverse_mass_at(*body_a, arm_a);
  if (body_b) inverse_mass += inverse_mass_at(*body_b, arm_b);
  solution = (Mat3::Identity() + give * inverse_mass).inverse();
  push(*body_a, impulse, arm_a);
  if (body_b) push(*body_b, -impulse, arm_b);
}

double SpringRow::solve(SolverBody* body_a, SolverBody* body_b) {
  Vec3 velocity = point_velocity(*body_a, arm_a);
  if (body_b) velocity -= point_velocity(*body_b, arm_b);
  const Vec3 next = solution * (pull - give * (velocity - inverse_mass * impulse));
  const Vec3 change = next - impulse;
  impulse = next;
  push(*body_a, change, arm_a);
  if (body_b) push(*body_b, -change, arm_b);
  return (inverse_mass * change).norm();
}

}  // namespace tweenfall::step
