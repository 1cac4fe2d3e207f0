#include "stage/drive_frame.h"

#include "stage/whole_pose.h"

namespace tweenfall::staging {

namespace {

/// The body above that carries the path of another; null for none.
const StagedBody* carrier(const StageState& state, const StagedBody& body, Drive::Frame frame) {
  const StagedBody* found = nullptr;
  if (frame == Drive::Frame::world) return found;
  for (NodeId node = (*state.nodes)[body.node].parent; node != no_node; node = (*state.nodes)[node].parent) {
    if (const StagedBody* above = state.body(node)) found = above;
    if (found && frame == Drive::Frame::parent) break;
  }
  return found;
}

/// Where a body that nothing leads will be at `end`.
Motion expected(const StageState& state, const StagedBody& body, double end) {
  const double ahead = end - state.time;
  Motion motion = moved_on(state.world.motion(body.id), state.world.mass(body.id).center, ahead);
  const std::uint32_t index = body.id.index;
  const bool pressed = index < state.presses.size() && state.presses[index] > 0;
  if (state.world.owner(body.id) != Owner::free || pressed || state.world.asleep(body.id)) return motion;
  motion.pose.position += ahead * ahead / 2 * state.gravity;
  motion.twist.linear += ahead * state.gravity;
  return motion;
}

}  // namespace

Motion carried_along(const StageState& state, const StagedBody& body, const Motion& path, WholePose& pose, double end) {
  const StagedBody* above = carrier(state, body, state.world.drive(body.id).frame);
  if (!above || state.world.is_fixed(above->id) || state.world.owner(above->id) == Owner::keyed) return path;
  const Motion there = expected(state, *above, end), authored = rigid(pose.at(*above));
  const Quat turn = (there.pose.rotation * authored.pose.rotation.conjugate()).normalized();
  const Vec3 arm = path.pose.position - authored.pose.position, carried = turn * arm;
  Motion wanted = path;
  wanted.pose.position = there.pose.position + carried;
  wanted.pose.rotation = (turn * path.pose.rotation).normalized();
  // The path's motion relative to its carrier's path becomes motion relative to the carrier.
  const Vec3 slip = path.twist.linear - authored.twist.linear - authored.twist.angular.cross(arm);
  wanted.twist.linear = there.twist.linear + there.twist.angular.cross(carried) + turn * slip;
  wanted.twist.angular = there.twist.angular + turn * (path.twist.angular - authored.twist.angular);
  return wanted;
}

}  // namespace tweenfall::staging
