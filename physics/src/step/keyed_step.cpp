#include "step/keyed_step.h"

#include <tweenfall/curves/rotation.h>

namespace tweenfall::step {

namespace {

/// Part of the change of velocity by which a path's mean velocity may differ from the mean of its end velocities.
constexpr double evenness = 0.1;
/// A change of velocity below this part of the velocity is taken as it is.
constexpr double slight = 0.01;
/// If a rate of displacement is uncertain by more than this, m/s or rad/s, it is mere rounding.
constexpr double certain = 1e-6;
constexpr double path_rounding = 4e-16;

/// One half of a course, from the displacement and the path's own velocities.
void fit(const Vec3& displacement, const Vec3& start, const Vec3& end, double size, double dt, Vec3& mean, Vec3& gain,
         Vec3& bow) {
  if (path_rounding * size > certain * dt) {
    mean = end;
    return;
  }
  mean = displacement / dt;
  const Vec3 change = end - start;
  // Where an acceleration passes through zero, the change is less than what the jerk of a curve makes of the mean.
  const Vec3 off = 0.5 * (start + end) - mean;
  if (!(off.norm() <= evenness * change.norm()) && !(change.norm() <= slight * mean.norm())) return;
  gain = change;
  bow = off;
}

/// Angular velocity, world axes, of a body whose rotation vector changes at this rate.
Vec3 angular_of(const Vec3& turn, const Vec3& rate) {
  return turn.cross(rate) == Vec3::Zero() ? rate : Vec3(right_jacobian(-turn) * rate);
}
/// The inverse.
Vec3 rate_of(const Vec3& turn, const Vec3& angular) {
  return turn.cross(angular) == Vec3::Zero() ? angular : Vec3(right_jacobian_inverse(-turn) * angular);
}

/// Mean rate between two parts of a step.
Vec3 between(const Vec3& mean, const Vec3& gain, const Vec3& bow, double from, double to) {
  const double sum = from + to;
  return mean + (0.5 * sum - 0.5) * gain + (1 - 3 * sum + 2 * (from * from + from * to + to * to)) * bow;
}

}  // namespace

bool KeyedCourse::still() const {
  return mean.linear == Vec3::Zero() && mean.angular == Vec3::Zero() && gain.linear == Vec3::Zero() &&
         gain.angular == Vec3::Zero() && bow.linear == Vec3::Zero() && bow.angular == Vec3::Zero();
}

Twist KeyedCourse::velocity(double share, double dt) const {
  const double bent = 1 - 6 * share + 6 * share * share;
  const Vec3 rate = mean.angular + (share - 0.5) * gain.angular + bent * bow.angular;
  const Vec3 turn = share * dt * between(mean.angular, gain.angular, bow.angular, 0, share);
  return {mean.linear + (share - 0.5) * gain.linear + bent * bow.linear, angular_of(turn, rate)};
}

Twist KeyedCourse::mean_between(double from, double to, double dt) const {
  const double middle = 0.5 * (from + to);
  const Vec3 turn = middle * dt * between(mean.angular, gain.angular, bow.angular, 0, middle);
  return {between(mean.linear, gain.linear, bow.linear, from, to),
          angular_of(turn, between(mean.angular, gain.angular, bow.angular, from, to))};
}

KeyedCourse keyed_course(const state::Body& body, double dt) {
  KeyedCourse course;
  if (body.fixed || !body.has_target) return course;
  const Vec3 arm = body.target().pose.rotation * body.mass().center;
  const Vec3 end = body.target().pose.position + arm;
  const Twist twist = shifted(body.target().twist, arm);
  const Vec3 turn = log_map(body.target().pose.rotation * body.motion.pose.rotation.conjugate());
  const double size = end.norm() + body.center.norm();
  fit(end - body.center, body.twist.linear, twist.linear, size, dt, course.mean.linear, course.gain.linear,
      course.bow.linear);
  fit(turn, body.twist.angular, rate_of(turn, twist.angular), 1, dt, course.mean.angular, course.gain.angular,
      course.bow.angular);
  return course;
}

Vec3 slip_change(const Twist& led, const Rider& rider) {
  const Vec3 swing = rider.twist.angular.cross(rider.core_arm);
  return rider.twist.angular.cross(swing) - led.angular.cross(rider.twist.linear + swing - led.linear);
}

SlipOfRider slip_of_rider(const LedBody& led, const Vec3& arm, const Rider& rider, double h) {
  const Vec3 change = h * slip_change(led.mean, rider);
  if (!rider.rolls) return {0.5 * change, change};
  // A ball has the velocity of the end from the start on, and the contact stays under it.
  const Vec3 after = change - led.ending.angular.cross(rider.under - arm);
  return {after - (led.ending.linear - led.mean.linear) - (led.ending.angular - led.mean.angular).cross(arm), after};
}

void arrive(state::Body& body) {
  if (body.fixed) return;
  if (body.has_target) {
    body.motion = body.target();
  } else {
    body.motion.twist = {};
    body.motion.scale_rate = Vec3::Zero();
  }
  body.has_target = false;
  body.target() = body.motion;
  body.target().twist = {};
  body.follow_motion();
}

}  // namespace tweenfall::step
