#include "handoff/arrival.h"

#include <tweenfall/curves/rotation.h>

namespace tweenfall::handing_over {

namespace {

constexpr double same = 1e-9;  // of what rounding alone moves

bool lies_elsewhere(const Pose& a, const Pose& b) {
  const Quat turn = hemisphere_aligned(a.rotation, b.rotation);
  return (a.position - b.position).norm() > same * (1 + b.position.norm()) ||
         (turn.coeffs() - b.rotation.coeffs()).norm() > same;
}

double change_of(const Twist& a, const Twist& b) {
  return (a.linear - b.linear).norm() + (a.angular - b.angular).norm();
}

}  // namespace

Motion carried_on(Motion motion, double seconds) noexcept {
  motion.pose.position += seconds * motion.twist.linear;
  motion.pose.rotation = (exp_map(Vec3(seconds * motion.twist.angular)) * motion.pose.rotation).normalized();
  motion.pose.scale += seconds * motion.scale_rate;
  return motion;
}

WorldMotion arriving(const Path& path, double instant) noexcept {
  const WorldMotion there = path.world(instant, Side::in);
  const double before = just_before(instant), earlier = just_before(before);
  if (path.side_at(earlier, Side::in) != Side::in) return there;  // nothing of the path was shown before
  const WorldMotion near = path.world(before, Side::in);
  WorldMotion here = near;
  here.motion = carried_on(near.motion, instant - before);
  here.linear += (instant - before) * near.linear_rate;
  const Twist &now = there.motion.twist, &then = near.motion.twist;
  // However fast a velocity changes, it does so as fast a moment earlier.
  const double usual = same * (1 + then.linear.norm() + then.angular.norm()) +
                       4 * change_of(then, path.world(earlier, Side::in).motion.twist);
  const bool leaps = lies_elsewhere(there.motion.pose, here.motion.pose) || change_of(now, then) > usual;
  return leaps ? here : there;
}

}  // namespace tweenfall::handing_over
