#include <tweenfall/anim/hierarchy.h>

#include <stdexcept>

namespace tweenfall {

WorldMotion child_of(const WorldMotion& parent, const Motion& local) noexcept {
  const Vec3& position = local.pose.position;
  const Mat3 turn = local.pose.rotation.toRotationMatrix();
  const Mat3 own = turn * local.pose.scale.asDiagonal();
  Mat3 spin;  // column by column: the angular velocity turns each axis
  for (int axis = 0; axis < 3; ++axis) spin.col(axis) = local.twist.angular.cross(own.col(axis));
  const Mat3 own_rate = spin + turn * local.scale_rate.asDiagonal();

  WorldMotion world;
  world.linear = parent.linear * own;
  world.linear_rate = parent.linear_rate * own + parent.linear * own_rate;

  const Pose& above = parent.motion.pose;
  Motion& motion = world.motion;
  motion.pose.position = parent.linear * position + above.position;
  motion.pose.rotation = above.rotation * local.pose.rotation;
  motion.pose.rotation.normalize();
  motion.pose.scale = above.scale.cwiseProduct(local.pose.scale);
  motion.twist.linear = parent.linear_rate * position + parent.linear * local.twist.linear + parent.motion.twist.linear;
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

}  // namespace tweenfall
