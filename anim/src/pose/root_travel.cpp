#include <tweenfall/anim/animation.h>
#include <tweenfall/anim/root_motion.h>
#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/rotation.h>

#include <cmath>
#include <stdexcept>

#include "blending/shares.h"

namespace tweenfall {

namespace pose {
namespace {

// The motion of a pose at rest.
Motion still(const Pose& pose) noexcept {
  Motion motion;
  motion.pose = pose;
  return motion;
}

}  // namespace
}  // namespace pose

Pose undone(const Pose& rigid) noexcept {
  const Quat back = rigid.rotation.conjugate();
  return {.position = -(back * rigid.position), .rotation = back};
}

Pose anchor(const Pose& place, const Pose& travelled) noexcept {
  return compose(place, undone(travelled));
}

Pose repeated(const Pose& rigid, double times) noexcept {
  const Vec3 r = log_map(rigid.rotation);
  const double angle = std::sqrt(r.squaredNorm());
  if (!(angle > 0)) return {.position = times * rigid.position};
  const Vec3 axis = r / angle;
  const Vec3 along = axis.dot(rigid.position) * axis, across = rigid.position - along;
  const double ratio = elementary::sin(0.5 * times * angle) / elementary::sin(0.5 * angle);
  return {.position = times * along + ratio * (exp_map((0.5 * (times - 1)) * r) * across),
          .rotation = exp_map(times * r)};
}

RootTravel::RootTravel(const Pose& first, const Pose& last) noexcept
    : first_(first), loop_(compose(undone(first), last)) {}

Motion RootTravel::at(const Motion& frame, double cycle) const noexcept {
  const Pose start = compose(repeated(loop_, cycle), undone(first_));
  return compose(pose::still(start), frame);
}

Motion RootTravel::step(const Pose& from, double from_cycle, const Motion& to, double to_cycle) const noexcept {
  Pose start = undone(from);
  if (to_cycle != from_cycle)
    start = compose(compose(compose(start, first_), repeated(loop_, to_cycle - from_cycle)), undone(first_));
  return compose(pose::still(start), to);
}

RootTravel root_travel(const RootMotion& root, std::shared_ptr<const Hierarchy> nodes, Clip clip) {
  if (!std::isfinite(clip.duration))
    throw std::invalid_argument("clip \"" + clip.name + "\" has no loops to travel by; its duration is " +
                                number_text(clip.duration) + " s");
  const double duration = clip.duration;
  clip.loop = {};
  const Animation animation(std::move(nodes), {std::move(clip)}, {Play{}});
  std::vector<Motion> pose(animation.nodes().size());
  animation.sample(0, pose);
  const Pose first = root.carried(pose).pose;
  animation.sample(duration, pose, Side::in);
  return {first, root.carried(pose).pose};
}

// With r the rotation vector and p the translation of a step, its screw has the rotation vector r and the translation
// u, where p = J(-r) u.
Motion blend_steps(std::span<const Motion> steps, std::span<const Sample<double>> weights) noexcept {
  blending::Whole whole;
  std::size_t loaded = 0, last = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double weight = blending::above_nothing(weights[i]).value;
    whole.add({weight, 0, 0});
    if (weight == 0) continue;
    ++loaded;
    last = i;
  }
  Motion result;
  if (whole.is_nothing()) return result;
  if (loaded == 1) return steps[last];
  Vec3 turn(0, 0, 0), way(0, 0, 0), spin(0, 0, 0), velocity(0, 0, 0);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double share = whole.share({blending::above_nothing(weights[i]).value, 0, 0}).value;
    if (share == 0) continue;
    const Motion& step = steps[i];
    const Vec3 r = log_map(step.pose.rotation);
    const Quat back = step.pose.rotation.conjugate();
    turn += share * r;
    way += share * (right_jacobian_inverse(-r) * step.pose.position);
    spin += share * (back * step.twist.angular);
    velocity += share * (back * step.twist.linear);
  }
  result.pose.rotation = exp_map(turn);
  result.pose.position = right_jacobian(-turn) * way;
  result.twist.angular = result.pose.rotation * spin;
  result.twist.linear = result.pose.rotation * velocity;
  return result;
}

}  // namespace tweenfall
