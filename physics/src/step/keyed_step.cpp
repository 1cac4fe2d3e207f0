#include "step/keyed_step.h"

#include <tweenfall/curves/rotation.h>

namespace tweenfall::step {

namespace {

/// Parts of the change of velocity by which a path's mean velocity may be off the mean of its ends.
constexpr double evenness = 0.1;
/// A change of velocity of this part of the velocity is taken as it is.
constexpr double slight = 0.01;
/// A rate of displacement that is uncertain by more than this, m/s or rad/s, is rounding and no rate.
constexpr double certain = 1e-6;
constexpr double path_rounding = 4e-16;

/// One half of a course, from the displacement and the path's own velocities.
void fit(const Vec3& displacement, const Vec3& start, const Vec3& end, double size, double dt, Vec3& mean, Vec3& gain) {
  if (path_rounding * size > certain * dt) {
    mean = end;
    return;
  }
  mean = displacement / dt;
  const Vec3 change = end - start;
  // Where an acceleration passes through zero the change is less than what a curve's jerk makes of the mean.
  const bool even = (mean - 0.5 * (start + end)).norm() <= evenness * change.norm();
  if (even || change.norm() <= slight * mean.norm()) gain = change;
}

}  // namespace

KeyedCourse keyed_course(const state::Body& body, double dt) {
  KeyedCourse course;
  if (body.fixed || !body.has_target) return course;
  const Vec3 arm = body.target.pose.rotation * body.mass.center;
  const Vec3 end = body.target.pose.position + arm;
  const Twist twist = shifted(body.target.twist, arm);
  const Vec3 turn = log_map(body.target.pose.rotation * body.motion.pose.rotation.conjugate());
  const double size = end.norm() + body.center.norm();
  fit(end - body.center, body.twist.linear, twist.linear, size, dt, course.mean.linear, course.gain.linear);
  fit(turn, body.twist.angular, twist.angular, 1, dt, course.mean.angular, course.gain.angular);
  return course;
}

void arrive(state::Body& body) {
  if (body.fixed) return;
  if (body.has_target) {
    body.motion = body.target;
  } else {
    body.motion.twist = {};
    body.motion.scale_rate = Vec3::Zero();
  }
  body.has_target = false;
  body.target = body.motion;
  body.target.twist = {};
  body.follow_motion();
}

}  // namespace tweenfall::step
