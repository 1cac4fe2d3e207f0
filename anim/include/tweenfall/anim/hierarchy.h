#pragma once

/// Nodes in a tree, and the way from local motions to world motions.
///
/// Every node has a rest pose relative to its parent. Given a local motion for each node,
/// `world_motions` returns where each is in the world and its exact twist, through any chain
/// of parents, moving, turning and scaling.

#include <tweenfall/curves/pose.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace tweenfall {

inline constexpr std::size_t no_node = static_cast<std::size_t>(-1);

struct Node {
  std::string name;
  std::size_t parent = no_node;  ///< index in the hierarchy, less than the node's own; `no_node` for a root
  Pose rest = {};                ///< relative to the parent
};

/// A node's place in the world.
struct WorldMotion {
  Mat3 linear = Mat3::Identity();   ///< rotation and scale of the whole chain, shear included
  Mat3 linear_rate = Mat3::Zero();  ///< 1/s
  Motion motion;                    ///< origin and its velocity; rotation: the chain's rotations multiplied (scales
                  ///< left out) and their exact angular velocity; scale: the chain's scales multiplied

  [[nodiscard]] Vec3 point(const Vec3& local) const noexcept { return linear * local + motion.pose.position; }
  [[nodiscard]] Vec3 point_velocity(const Vec3& local) const noexcept {
    return linear_rate * local + motion.twist.linear;
  }
};

class Hierarchy {
 public:
  Hierarchy() = default;

  /// Nodes in any order (parents may come later); they are sorted so that parents come first, otherwise keeping order.
  /// `parents` refers to positions in `nodes`. @throws std::invalid_argument naming the node: a name twice, a parent
  /// out of range, a cycle.
  explicit Hierarchy(std::vector<Node> nodes);

  /// Appends a node below an existing parent. @returns its index. @throws as the constructor.
  std::size_t add(Node node);

  [[nodiscard]] std::size_t size() const noexcept { return nodes_.size(); }
  [[nodiscard]] const Node& operator[](std::size_t index) const noexcept { return nodes_[index]; }
  [[nodiscard]] std::span<const Node> nodes() const noexcept { return nodes_; }
  [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const;

  /// World motion of every node. @param local  one per node, in order  @param world  written, same size
  void world_motions(std::span<const Motion> local, std::span<WorldMotion> world) const noexcept;

  /// World motion of one node alone, walking its chain of parents.
  /// @param local_of  called with each index of the chain
  template <class LocalOf>
  [[nodiscard]] WorldMotion world_motion(std::size_t index, LocalOf&& local_of) const {
    const std::size_t parent = nodes_[index].parent;
    if (parent == no_node) return child_of(WorldMotion{}, local_of(index));
    return child_of(world_motion(parent, local_of), local_of(index));
  }

 private:
  std::vector<Node> nodes_;
  std::unordered_map<std::string, std::size_t> index_;
};

/// World motion of a child from its parent's and its own local motion.
[[nodiscard]] WorldMotion child_of(const WorldMotion& parent, const Motion& local) noexcept;

}  // namespace tweenfall
