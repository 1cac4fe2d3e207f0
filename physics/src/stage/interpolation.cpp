#include <tweenfall/curves/hermite.h>
#include <tweenfall/curves/rotation.h>

#include <algorithm>

#include "stage/between.h"
#include "stage/stage_data.h"
#include "stage/whole_pose.h"

namespace tweenfall::staging {

namespace {

/// Whether the later of two states is shown: near it, a body is where its own velocity takes it.
bool at_end(const StageState& from, const StageState& to, double time) {
  return !is_between(from, to, time);
}

bool touched(const StageState& state, BodyId body) {
  return body.index < state.presses.size() && state.presses[body.index] > 0;
}

/// Whether a way belongs to velocities that changed evenly: not in a blow. Up to this difference, the Hermite cubic of
/// a body that a blow stops does not overshoot: there its slope is at most 2.5 of 3 times the chord's.
/// Source: Fritsch and Carlson, Monotone Piecewise Cubic Interpolation, 1980.
bool changed_evenly(const Vec3& way, const Vec3& start, const Vec3& end, double span) {
  return (way - 0.5 * span * (start + end)).norm() <= 0.1 * span * (end - start).norm();
}

/// A free body between two states: pose of the origin, twist at the center of mass. Its center follows the Hermite
/// cubic of its own positions and velocities, which is the exact parabola of free flight, and of what rides on an
/// elevator; but if a blow has changed the velocity in between, no cubic of the two ends is right, and the straight
/// line does not overshoot.
Motion between(const StageState& from, const StageState& to, const StagedBody& body, double time) {
  const double span = to.time - from.time, u = (time - from.time) / span;
  const Vec3 center = to.world.mass(body.id).center;
  const Motion start = from.world.motion(body.id), end = to.world.motion(body.id);
  const Twist twist_start = from.world.twist(body.id), twist_end = to.world.twist(body.id);
  const Vec3 place_start = center_of(start, center), place_end = center_of(end, center);

  const Quat relative = hemisphere_aligned(start.pose.rotation.conjugate() * end.pose.rotation, Quat(1, 0, 0, 0));
  const Vec3 turn = log_map(relative);

  Motion motion;
  Vec3 place;
  const bool flies = !touched(to, body.id);
  if (flies || changed_evenly(place_end - place_start, twist_start.linear, twist_end.linear, span)) {
    const Sample<Vec3> path =
        hermite::sample<Vec3>(place_start, twist_start.linear, place_end, twist_end.linear, span, u);
    place = path.value;
    motion.twist.linear = path.rate;
  } else {
    place = place_start + u * (place_end - place_start);
    motion.twist.linear = twist_start.linear + u * (twist_end.linear - twist_start.linear);
  }
  if (flies || changed_evenly(start.pose.rotation * turn, twist_start.angular, twist_end.angular, span)) {
    // The rotation vector from the start's frame, with the end rates that give both angular velocities.
    const Vec3 rate_start = start.pose.rotation.conjugate() * twist_start.angular;
    const Vec3 rate_end = right_jacobian_inverse(turn) * (end.pose.rotation.conjugate() * twist_end.angular);
    const Sample<Vec3> r = hermite::sample<Vec3>(Vec3(0, 0, 0), rate_start, turn, rate_end, span, u);
    motion.pose.rotation = start.pose.rotation * exp_map(r.value);
    motion.twist.angular = motion.pose.rotation * Vec3(right_jacobian(r.value) * r.rate);
  } else {
    motion.pose.rotation = start.pose.rotation * exp_map(u * turn);
    motion.twist.angular = twist_start.angular + u * (twist_end.angular - twist_start.angular);
  }
  motion.pose.rotation.normalize();
  motion.pose.position = place - motion.pose.rotation * center;
  return motion;
}

/// Pose of the origin, twist at the center of mass.
Motion shown_motion(const StageState& from, const StageState& to, const StagedBody& body, double time) {
  if (at_end(from, to, time) || from.world.owner(body.id) == Owner::keyed || !from.world.contains(body.id)) {
    const StageState& state = at_end(from, to, time) ? to : from;
    if (state.world.owner(body.id) == Owner::keyed && !state.world.is_fixed(body.id)) {
      Motion motion = body.path.at(time);
      motion.twist = shifted(motion.twist, motion.pose.rotation * state.world.mass(body.id).center);
      return motion;
    }
    const bool still = state.world.is_fixed(body.id) || state.world.asleep(body.id);
    const double since = still || !at_end(from, to, time) ? 0 : time - state.time;
    Motion motion = moved_on(state.world.motion(body.id), state.world.mass(body.id).center, since);
    motion.twist = state.world.twist(body.id);
    return motion;
  }
  return between(from, to, body, time);
}

const StagedBody& body_in_force(const StageState& from, const StageState& to, std::size_t body, double time) {
  return at_end(from, to, time) || body >= from.bodies.size() ? to.bodies[body] : from.bodies[body];
}

/// The nearest body above a node without one, whose clock the node follows.
const StagedBody* body_above(const StageState& state, NodeId node) {
  for (NodeId i = node; i != no_node; i = (*state.nodes)[i].parent)
    if (const StagedBody* body = state.body(i)) return body;
  return nullptr;
}

}  // namespace

Motion local_motion(const StageState& state, const StagedBody* above, NodeId node, double time, Side side) {
  const Motion local = state.animation->sample_node(node, time, side, above ? above->path.clock() : ClockOverride{});
  if (!above || !above->below) return local;
  const auto found = std::ranges::lower_bound(*above->below, node, {}, &SettlingNode::node);
  if (found == above->below->end() || found->node != node) return local;
  Motion settled = found->offset.apply(time, local);
  if (!found->size.any) return settled;
  const Sample<Vec3> size = settled_size(found->size, time, local);
  settled.pose.scale = size.value;
  settled.scale_rate = size.rate;
  return settled;
}

WorldMotion StagedBody::sized(double time, const WorldMotion& on_path) const noexcept {
  if (!size) return on_path;
  const Vec3 before = on_path.motion.pose.scale, rate_before = on_path.motion.scale_rate;
  const Sample<Vec3> settled = settled_size(*size, time, on_path.motion);
  WorldMotion world = on_path;
  for (int i = 0; i < 3; ++i) {
    // Along an axis without size there is nothing to stretch.
    if (before[i] == 0) continue;
    const double more = settled.value[i] / before[i];
    const double more_rate = (settled.rate[i] - more * rate_before[i]) / before[i];
    world.linear_rate.col(i) = more * on_path.linear_rate.col(i) + more_rate * on_path.linear.col(i);
    world.linear.col(i) = more * on_path.linear.col(i);
    world.motion.pose.scale[i] = settled.value[i];
    world.motion.scale_rate[i] = settled.rate[i];
  }
  return world;
}

WorldMotion body_world(const StageState& from, const StageState& to, std::size_t index, double time) {
  const StagedBody& body = body_in_force(from, to, index, time);
  const StageState& state = at_end(from, to, time) ? to : from;
  if (state.world.owner(body.id) == Owner::keyed && !state.world.is_fixed(body.id))
    return body.sized(time, body.path.world(time));
  Motion motion = shown_motion(from, to, body, time);
  motion.twist = shifted(motion.twist, -(motion.pose.rotation * state.world.mass(body.id).center));
  WorldMotion shape = *body.shown;
  shape.linear_rate.setZero();
  shape.motion.twist = {};
  shape.motion.scale_rate.setZero();
  return carried(shape, motion);
}

Pose body_pose(const StageState& from, const StageState& to, std::size_t index, double time) {
  return rigid(shown_motion(from, to, body_in_force(from, to, index, time), time)).pose;
}

Twist body_twist(const StageState& from, const StageState& to, std::size_t index, double time) {
  return shown_motion(from, to, body_in_force(from, to, index, time), time).twist;
}

void stage_world(const StageState& from, const StageState& to, double time, std::span<WorldMotion> out) {
  const StageState& state = at_end(from, to, time) ? to : from;
  WholePose pose(state, time, Side::out);
  std::vector<const StagedBody*> above(out.size(), nullptr);
  for (NodeId node = 0; node < out.size(); ++node) {
    if (const StagedBody* body = state.body(node)) {
      const bool on_path = state.world.owner(body->id) == Owner::keyed && !state.world.is_fixed(body->id);
      out[node] = on_path ? pose.world(*body) : body_world(from, to, state.body_of[node], time);
      above[node] = body;
      continue;
    }
    const std::size_t parent = (*state.nodes)[node].parent;
    if (parent != no_node) above[node] = above[parent];
    const StagedBody* body = above[node];
    const bool plain = !body || (body->path.clock() == ClockOverride{} && !body->below);
    out[node] = child_of(parent == no_node ? WorldMotion{} : out[parent],
                         plain ? pose.local(node) : local_motion(state, body, node, time));
  }
}

WorldMotion node_world(const StageState& from, const StageState& to, NodeId node, double time) {
  const StageState& state = at_end(from, to, time) ? to : from;
  std::vector<NodeId> below;  // the chain down from the nearest body, or from the root
  NodeId i = node;
  while (i != no_node && state.body_of[i] == no_body) {
    below.push_back(i);
    i = (*state.nodes)[i].parent;
  }
  WorldMotion world = i == no_node ? WorldMotion{} : body_world(from, to, state.body_of[i], time);
  const StagedBody* above = body_above(state, node);
  for (auto it = below.rbegin(); it != below.rend(); ++it)
    world = child_of(world, local_motion(state, above, *it, time));
  return world;
}

}  // namespace tweenfall::staging
