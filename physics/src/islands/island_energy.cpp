#include "islands/island_energy.h"

#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>

namespace tweenfall::islands {

namespace {

Mat3 inertia_of(const state::Body& body, const Quat& rotation) {
  return body.spherical() ? body.mass().inertia : body.world_inertia(rotation);
}

}  // namespace

void IslandEnergy::add(const state::Body& body, const forces::Load& load, const BodyCourse& course) {
  const double mass = body.mass().mass;
  const Vec3 force = 0.5 * mass * (load.acceleration + load.end_acceleration);
  limit += 0.5 * mass * course.start.linear.squaredNorm() +
           0.5 * course.start.angular.dot(inertia_of(body, course.start_rotation) * course.start.angular) +
           force.dot(course.center - course.start_center);
  if (load.torque != Vec3::Zero())
    limit += load.torque.dot(log_map(course.rotation * course.start_rotation.conjugate()));
  const Mat3 inertia = inertia_of(body, course.rotation);
  const Vec3 linear = course.after.linear - course.before.linear;
  const Vec3 angular = course.after.angular - course.before.angular;
  const Vec3 momentum = inertia * course.before.angular;
  without += 0.5 * mass * course.before.linear.squaredNorm() + 0.5 * course.before.angular.dot(momentum);
  slope += mass * linear.dot(course.before.linear) + angular.dot(momentum);
  curvature += 0.5 * mass * linear.squaredNorm() + 0.5 * angular.dot(inertia * angular);
}

void IslandEnergy::add(double mass, double moment, const Twist& start, const Twist& before, const Twist& after,
                       double work) {
  limit += 0.5 * mass * start.linear.squaredNorm() + 0.5 * moment * start.angular.squaredNorm() + work;
  const Vec3 linear = after.linear - before.linear;
  const Vec3 angular = after.angular - before.angular;
  without += 0.5 * mass * before.linear.squaredNorm() + 0.5 * moment * before.angular.squaredNorm();
  slope += mass * linear.dot(before.linear) + moment * angular.dot(before.angular);
  curvature += 0.5 * mass * linear.squaredNorm() + 0.5 * moment * angular.squaredNorm();
}

double IslandEnergy::share_within() const {
  const double excess = without - limit;
  if (!(excess + slope + curvature > 0)) return 1;
  if (!(curvature > 0)) return 1;
  const double square = slope * slope - 4 * curvature * excess;
  if (!(square >= 0) || excess > 0) return 0;
  return std::clamp((std::sqrt(square) - slope) / (2 * curvature), 0.0, 1.0);
}

}  // namespace tweenfall::islands
