#include <tweenfall/anim/hierarchy.h>

#include <cmath>
#include <stdexcept>

#include "pose/moving_frame.h"

namespace tweenfall {

namespace pose {
namespace {

MovingFrame read(const Mat3& linear, const Mat3& rate, const Vec3& origin, const Vec3& velocity) noexcept {
  MovingFrame frame;
  for (int i = 0; i < 3; ++i) frame.axes[i] = MovingColumn::read(linear.data() + 3 * i, rate.data() + 3 * i);
  frame.origin = MovingColumn::read(origin.data(), velocity.data());
  return frame;
}

void write(const MovingFrame& frame, Mat3& linear, Mat3& rate, Vec3& origin, Vec3& velocity) noexcept {
  for (int i = 0; i < 3; ++i) frame.axes[i].write(linear.data() + 3 * i, rate.data() + 3 * i);
  frame.origin.write(origin.data(), velocity.data());
}

// Near a length of 1, as products of rotations are, by a step of Newton's that leaves less than a rounding.
Quat near_unit(const Quat& q) noexcept {
  const double excess = q.squaredNorm() - 1;
  if (!(std::abs(excess) < 1e-9)) return q.normalized();
  return Quat(q.coeffs() * (1 - 0.5 * excess));
}

}  // namespace
}  // namespace pose

WorldMotion child_of(const WorldMotion& parent, const Motion& local) noexcept {
  const Pose& above = parent.motion.pose;
  WorldMotion world;
  Motion& motion = world.motion;
  const pose::MovingFrame frame =
      pose::read(parent.linear, parent.linear_rate, above.position, parent.motion.twist.linear);
  pose::write(pose::child_frame(frame, local), world.linear, world.linear_rate, motion.pose.position,
              motion.twist.linear);
  motion.pose.rotation = pose::near_unit(above.rotation * local.pose.rotation);
  motion.pose.scale = above.scale.cwiseProduct(local.pose.scale);
  motion.twist.angular = parent.motion.twist.angular + above.rotation * local.twist.angular;
  motion.scale_rate =
      parent.motion.scale_rate.cwiseProduct(local.pose.scale) + above.scale.cwiseProduct(local.scale_rate);
  return world;
}

Hierarchy::Hierarchy(std::vector<Node> nodes) {
  nodes_.reserve(nodes.size());
  for (Node& node : nodes) add(std::move(node));
}

std::size_t Hierarchy::add(Node node) {
  const std::size_t index = nodes_.size();
  if (node.parent != no_node && node.parent >= index)
    throw std::invalid_argument("node \"" + node.name + "\" (number " + std::to_string(index) + ") has parent number " +
                                std::to_string(node.parent) + "; a parent must come before its children");
  if (!index_.emplace(node.name, index).second)
    throw std::invalid_argument("two nodes are named \"" + node.name + "\"");
  nodes_.push_back(std::move(node));
  return index;
}

std::optional<std::size_t> Hierarchy::find(std::string_view name) const {
  const auto found = index_.find(std::string(name));
  if (found == index_.end()) return std::nullopt;
  return found->second;
}

void Hierarchy::world_motions(std::span<const Motion> local, std::span<WorldMotion> world) const noexcept {
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    world[i] = child_of(nodes_[i].parent == no_node ? WorldMotion{} : world[nodes_[i].parent], local[i]);
}

void Hierarchy::world_frames(std::span<const Motion> local, std::span<WorldFrame> world) const noexcept {
  static const WorldFrame outside;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const WorldFrame& above = nodes_[i].parent == no_node ? outside : world[nodes_[i].parent];
    WorldFrame& frame = world[i];
    pose::write(pose::child_frame(pose::read(above.linear, above.linear_rate, above.origin, above.velocity), local[i]),
                frame.linear, frame.linear_rate, frame.origin, frame.velocity);
  }
}

}  // namespace tweenfall
