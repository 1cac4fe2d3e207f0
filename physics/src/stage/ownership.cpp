#include "stage/stage_data.h"

#include <tweenfall/curves/rotation.h>

#include <stdexcept>

namespace tweenfall {

namespace {

/// The same motion with its twist told at the center of mass: v = v_o + w x r.
Motion about_center(Motion motion, const Vec3& center) {
  const Vec3 arm = motion.pose.rotation * center;
  motion.twist = shifted(motion.twist, arm);
  return motion;
}

/// What an engine that differences its frames would hand over: the mean twist of the last `span` seconds.
Twist mean_twist(const Path& path, double time, double span, const Vec3& center) {
  const Motion now = path.at(time, Side::in), earlier = path.at(time - span, Side::out);
  const Quat turned = hemisphere_aligned(now.pose.rotation * earlier.pose.rotation.conjugate(), Quat(1, 0, 0, 0));
  return {(center_of(now, center) - center_of(earlier, center)) / span, log_map(turned) / span};
}

/// Twist at the center of mass with which a body leaves its path.
Twist take_over_twist(const StagedBody& body, const Motion& arriving, const TakeOver& settings, double time,
                      double step, const Vec3& center) {
  Twist twist;
  switch (settings.velocity) {
    case TakeOver::Velocity::curve:
      twist = about_center(arriving, center).twist;
      break;
    case TakeOver::Velocity::step:
      twist = mean_twist(body.path, time, step, center);
      break;
    case TakeOver::Velocity::average:
      twist = mean_twist(body.path, time, settings.average_over, center);
      break;
    case TakeOver::Velocity::zero:
      break;
  }
  twist.linear = settings.scale * twist.linear + settings.add.linear;
  twist.angular = settings.scale * twist.angular + settings.add.angular;
  return twist;
}

}  // namespace

void change_owner(StageState& state, std::size_t index, const Drive& to, Cause cause, const TakeOver& take_over,
                  const HandBack& hand_back, double step, std::vector<Happening>& happenings) {
  StagedBody& body = state.bodies[index];
  World& world = state.world;
  if (world.is_fixed(body.id))
    throw std::invalid_argument("\"" + (*state.nodes)[body.node].name + "\" is static: nothing can take it over");
  if (world.drive(body.id) == to) return;
  const Vec3 center = world.mass(body.id).center;
  HandOff handoff{.node = body.node,
                  .from = world.owner(body.id),
                  .to = to.owner(),
                  .time = state.time,
                  .cause = cause,
                  .before = {},
                  .after = {}};

  if (handoff.from == Owner::keyed) {
    // The motion shown up to now is the one that arrives.
    body.shown = body.path.world(state.time, Side::in);
    body.released_at = state.time;
    Motion motion = body.shown.motion;
    motion.pose.scale = Vec3(1, 1, 1);
    motion.scale_rate.setZero();
    handoff.before = about_center(motion, center);
    const Twist twist = take_over_twist(body, motion, take_over, state.time, step, center);
    motion.twist = shifted(twist, -(motion.pose.rotation * center));
    world.set_drive(body.id, to);
    world.set_motion(body.id, motion);
    handoff.after = handoff.before;
    handoff.after.twist = twist;
  } else {
    const Motion motion = world.motion(body.id);
    handoff.before = about_center(motion, center);
    handoff.after = handoff.before;
    world.set_drive(body.id, to);
    if (handoff.to == Owner::keyed) {
      body.path = body.path.recovered(state.time, hand_back, motion, body.released_at);
      Motion onward = body.path.at(state.time);
      onward.pose.scale = Vec3(1, 1, 1);
      onward.scale_rate.setZero();
      world.set_motion(body.id, onward);
      handoff.after = about_center(onward, center);
    }
  }
  happenings.push_back({state.time, handoff});
}

}  // namespace tweenfall
