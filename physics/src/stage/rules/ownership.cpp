#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <stdexcept>

#include "handoff/arrival.h"
#include "stage/rules/overlaps.h"
#include "stage/rules/ramps.h"
#include "stage/stage_data.h"

namespace tweenfall::staging {

namespace {

/// The same motion with its twist at the center of mass: v = v_o + w x r.
Motion about_center(Motion motion, const Vec3& center) {
  const Vec3 arm = motion.pose.rotation * center;
  motion.twist = shifted(motion.twist, arm);
  return motion;
}

/// What an engine that differences its frames would hand over: the mean twist of the last `span` seconds.
Twist mean_twist(const Path& path, double time, double span, const Vec3& center) {
  const Motion now = handing_over::arriving(path, time).motion, earlier = path.at(time - span, Side::out);
  const Quat turned = hemisphere_aligned(now.pose.rotation * earlier.pose.rotation.conjugate(), Quat(1, 0, 0, 0));
  return {(center_of(now, center) - center_of(earlier, center)) / span, log_map(turned) / span};
}

Twist scaled_and_added(Twist twist, const TakeOver& settings) {
  twist.linear = settings.scale * twist.linear + settings.add.linear;
  twist.angular = settings.scale * twist.angular + settings.add.angular;
  return twist;
}

/// Applies the settings to the own twist of a body that a drive lets go.
void change_own_twist(World& world, BodyId body, const Vec3& center, const TakeOver& settings, Motion& after) {
  const bool zero = settings.velocity == TakeOver::Velocity::zero;
  const Twist twist = scaled_and_added(zero ? Twist{} : after.twist, settings);
  if (twist.linear == after.twist.linear && twist.angular == after.twist.angular) return;
  Motion motion = world.motion(body);
  motion.twist = shifted(twist, -(motion.pose.rotation * center));
  world.set_motion(body, motion);
  after.twist = twist;
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
  return scaled_and_added(twist, settings);
}

bool are_joined(const StageState& state, NodeId a, NodeId b) {
  return std::ranges::any_of(state.joints->list, [&](const StagedJoint& joint) {
    return ((joint.a == a && joint.b == b) || (joint.a == b && joint.b == a)) && state.world.contains(joint.id);
  });
}

/// The next body above, if the two are joined and it is no scenery; else null.
const StagedBody* joined_above(const StageState& state, const StagedBody& body) {
  for (NodeId node = (*state.nodes)[body.node].parent; node != no_node; node = (*state.nodes)[node].parent)
    if (const StagedBody* const above = state.body(node))
      return are_joined(state, node, body.node) && !state.world.is_fixed(above->id) ? above : nullptr;
  return nullptr;
}

/// The topmost body of the figure of a body: up to it, each is joined to the next one above.
const StagedBody& top_of_figure(const StageState& state, const StagedBody& body) {
  const StagedBody* top = &body;
  while (const StagedBody* const above = joined_above(state, *top)) top = above;
  return *top;
}

bool on_its_way(const StageState& state, const StagedBody& body) {
  return state.world.owner(body.id) != Owner::free && !state.world.is_fixed(body.id);
}

/// A path that settles as seen from others is evaluated together with all of them: in long chains, every so many bodies
/// one settles by itself.
constexpr std::ptrdiff_t most_above = 32;

/// The path as seen from which a body settles; null for none.
const Path* path_above(const StageState& state, const StagedBody& body) {
  const StagedBody* const next = joined_above(state, body);
  if (!next || !on_its_way(state, *next)) return nullptr;
  std::ptrdiff_t above = 1;
  for (const Path* path = next->path.above(); path; path = path->above()) ++above;
  return above < most_above ? &next->path : nullptr;
}

/// The path of a body that follows one again. In a figure all are moved alike: as that of its topmost body, even if
/// that comes later or not at all; else its limbs would go their own ways. And each settles along with the one above,
/// if that follows a path; else their joint would open.
Path path_again(const StageState& state, const StagedBody& body, const HandBack& hand_back, double begins) {
  const auto recovered = [&](const StagedBody& one, const Path* leader, const Path* above) {
    const Vec3 center = state.world.mass(one.id).center;
    const Motion beginning = moved_on(state.world.motion(one.id), center, begins - state.time);
    return one.path.recovered(begins, hand_back, beginning, one.released_at, leader, above);
  };
  const Path* const above = path_above(state, body);
  if (hand_back.anchor == HandBack::Anchor::keep || !joined_above(state, body)) return recovered(body, nullptr, above);
  const StagedBody& top = top_of_figure(state, body);
  const Path leader = state.world.owner(top.id) == Owner::free ? recovered(top, nullptr, nullptr) : top.path;
  return recovered(body, &leader, above);
}

/// What came back below a body at `time`, before it came back itself, settles along with it after all.
void settle_below(StageState& state, const StagedBody& body, double time) {
  for (const NodeId node : state.below(body.node, [](NodeId) { return true; })) {
    StagedBody* const one = state.body(node);
    if (!one || !one->path.starts_settling(time) || !on_its_way(state, *one)) continue;
    const Path* const above = path_above(state, *one);
    if (above && above->starts_settling(time)) one->path = one->path.along(*above);
  }
}

/// The nodes without bodies below a body that changes from one path to another at `time`, each from where it is shown.
std::shared_ptr<const std::vector<SettlingNode>> settling_below(const StageState& state, const StagedBody& body,
                                                                const Path& next, const Settle& settle, double time) {
  if (next.clock() == body.path.clock()) return body.below;
  auto below = std::make_shared<std::vector<SettlingNode>>();
  const std::vector<NodeId> carried =
      state.below(body.node, [&](NodeId node) { return state.body_of[node] == no_body; });
  below->reserve(carried.size());
  for (const NodeId node : carried) {
    const Motion shown = local_motion(state, &body, node, time, Side::in);
    const Motion led = state.animation->sample_node(node, time, Side::out, next.clock());  // no path, so no `since`
    below->push_back({node, SettleOffset(settle, time, led, shown), size_offset(settle, time, led, shown)});
  }
  return below;
}

/// Whether the body may not leave its path because it overlaps others; if so, this is reported.
bool is_vetoed(const StageState& state, const StagedBody& body, double instant, const TakeOver& take_over,
               std::vector<Happening>& happenings) {
  if (take_over.overlap != TakeOver::Overlap::veto) return false;
  const std::vector<BodyId> others =
      bodies_in(state, body, rigid(handing_over::arriving(body.path, instant).motion).pose);
  if (others.empty()) return false;
  StageEvent event;
  event.time = instant;
  event.name = "vetoed";
  event.nodes = {body.node, state.node_of[others.front().index]};
  Happening& happening = happenings.emplace_back();
  happening.time = instant;
  happening.what.emplace<StageEvent>(std::move(event));
  return true;
}

/// Lets the body pass through what it overlaps until they are apart.
void pass_through(StageState& state, const StagedBody& body, double instant) {
  for (const BodyId& other : bodies_in(state, body, rigid(handing_over::arriving(body.path, instant).motion).pose)) {
    state.world.ignore(body.id, other);
    state.passing.emplace_back(body.id, other);
  }
}

/// When the path of a body to be rewound was last clear; empty if it is clear now, or was not for long.
std::optional<double> clear_time(const StageState& state, const StagedBody& body, const Pose& pose, double instant,
                                 const TakeOver& take_over, double step) {
  if (take_over.overlap != TakeOver::Overlap::rewind || bodies_in(state, body, pose).empty()) return {};
  return last_clear(state, body, instant, take_over.rewind_within, step);
}

}  // namespace

bool change_owner(StageState& state, std::size_t index, const OwnerChange& change, Cause cause, double instant,
                  double step, std::vector<Happening>& happenings) {
  StagedBody& body = state.bodies[index];
  World& world = state.world;
  if (world.is_fixed(body.id))
    throw std::invalid_argument("\"" + (*state.nodes)[body.node].name + "\" is static: nothing can take it over");
  const Drive before = world.drive(body.id);
  if (before == change.to && !body.ramp) return true;
  const TakeOver& take_over = change.take_over;
  const HandBack& hand_back = change.hand_back;
  std::optional<Ramp> ramp;
  if (change.ramp > 0) ramp = Ramp{before, change.to, instant, change.ramp, hand_back.settle};
  const Drive to = ramp ? drive_at_start(*ramp) : change.to;
  const Vec3 center = world.mass(body.id).center;
  const double onward = state.time - instant;
  HandOff handoff{.node = body.node,
                  .from = before.owner(),
                  .to = to.owner(),
                  .time = instant,
                  .cause = cause,
                  .before = {},
                  .after = {}};

  if (handoff.from == Owner::keyed && is_vetoed(state, body, instant, take_over, happenings)) return false;
  if (handoff.from == Owner::keyed) {
    if (take_over.overlap == TakeOver::Overlap::ignore) pass_through(state, body, instant);
    // The motion shown up to now is the one that arrives.
    body.shown = std::make_shared<const WorldMotion>(body.sized(instant, handing_over::arriving(body.path, instant)));
    body.released_at = instant;
    Motion motion = rigid(body.shown->motion);
    handoff.before = handoff.after = about_center(motion, center);
    double leaves_at = instant;
    if (const std::optional<double> clear = clear_time(state, body, motion.pose, instant, take_over, step)) {
      leaves_at = *clear;
      body.shown = std::make_shared<const WorldMotion>(body.sized(leaves_at, body.path.world(leaves_at, Side::in)));
      motion = rigid(body.shown->motion);
      handoff.after = about_center(motion, center);
    }
    const Twist twist = take_over_twist(body, motion, take_over, leaves_at, step, center);
    motion.twist = shifted(twist, -(motion.pose.rotation * center));
    Motion released = moved_on(motion, center, onward);
    // A velocity that is late by a sliver of fall would be wrong for as long as it falls.
    released.twist.linear += onward * state.gravity;
    static_cast<void>(bearable(state, body, released, "the hand-off"));
    world.set_drive(body.id, to);
    world.set_motion(body.id, released);
    handoff.after.twist = twist;
  } else {
    const Motion motion = moved_on(world.motion(body.id), center, -onward);
    handoff.before = about_center(motion, center);
    handoff.after = handoff.before;
    // If it is taken back, or goes from free to a drive, it follows a path again.
    const Owner last = change.to.owner();
    const bool follows = last == Owner::keyed || (handoff.to == Owner::driven && handoff.from == Owner::free) ||
                         (last == Owner::driven && !hand_back.clip.empty());
    // What is due just after a step is done at the step: the path starts there, or it would not yet have started.
    const double begins = std::min(instant, state.time);
    const auto below = [&](const Path& next) { return settling_below(state, body, next, hand_back.settle, begins); };
    const Path path = follows ? path_again(state, body, hand_back, begins) : body.path;
    world.set_drive(body.id, to);
    if (handoff.from == Owner::driven && last == Owner::free)
      change_own_twist(world, body.id, center, take_over, handoff.after);
    body.below = below(path);
    if (follows) {
      // A free or driven body keeps the size with which it left its path.
      Motion shown = body.shown->motion;
      shown.scale_rate.setZero();
      const SizeOffset size = size_offset(hand_back.settle, begins, path.world(begins, Side::out).motion, shown);
      body.size = size.any ? std::make_shared<const SizeOffset>(size) : nullptr;
    }
    body.path = path;
    if (follows) settle_below(state, body, begins);
    if (handoff.to == Owner::keyed) {
      world.set_motion(body.id, bearable(state, body, rigid(body.path.at(state.time)), "its path"));
      handoff.after = about_center(rigid(body.path.at(instant)), center);
    }
  }
  body.by_track = false;
  body.saturated_for = 0;
  body.ramp = ramp;
  state.ramps = state.ramps || ramp;
  body.coming.reset();
  happenings.push_back({instant, handoff});
  return true;
}

}  // namespace tweenfall::staging
