#pragma once

/// Nodes in a tree, and the conversion from local motions to world motions.
///
/// Every node has a rest pose relative to its parent. Given a local motion for each node,
/// `world_motions` returns where each is in the world and its exact twist, through any chain
/// of parents, moving, turning and scaling; `world_frames` where its points are and how fast they move, which is enough
/// for drawing and takes half the time.

#include <tweenfall/curves/pose.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall {

inline constexpr std::size_t no_node = static_cast<std::size_t>(-1);

struct Node {
  std::string name;
  std::size_t parent = no_node;   ///< index in the hierarchy, less than the node's own; `no_node` for a root
  Pose rest = {};                 ///< relative to the parent
  std::optional<Color> color{};   ///< shown where no clip colors the node; a clip's color fades from it
  std::vector<double> weights{};  ///< likewise for the morph weights of its mesh
};

/// A node's transform in the world, with its rates.
struct WorldMotion {
  Mat3 linear = Mat3::Identity();   ///< rotation and scale of the whole chain, shear included
  Mat3 linear_rate = Mat3::Zero();  ///< 1/s
  Motion motion;                    ///< as by `compose`, but the origin exact: the chain's rotations and its scales
                  ///< multiplied, with exact rates; `linear` is that rotation times that scale unless sheared

  [[nodiscard]] Vec3 point(const Vec3& local) const noexcept { return linear * local + motion.pose.position; }
  [[nodiscard]] Vec3 point_velocity(const Vec3& local) const noexcept {
    return linear_rate * local + motion.twist.linear;
  }
};

/// Where the points of a node's own space are in the world, and how fast they move there.
struct WorldFrame {
  Mat3 linear = Mat3::Identity();   ///< rotation and scale of the whole chain, shear included
  Mat3 linear_rate = Mat3::Zero();  ///< 1/s
  Vec3 origin{0, 0, 0};             ///< m
  Vec3 velocity{0, 0, 0};           ///< of the origin, m/s

  [[nodiscard]] Vec3 point(const Vec3& local) const noexcept { return linear * local + origin; }
  [[nodiscard]] Vec3 point_velocity(const Vec3& local) const noexcept { return linear_rate * local + velocity; }
};

/// World motion of a child from its parent's and its own local motion.
[[nodiscard]] WorldMotion child_of(const WorldMotion& parent, const Motion& local) noexcept;

/// Copies share their nodes: copying a hierarchy and adding to the copy takes the same time for any number of nodes,
/// and leaves the original as it was.
class Hierarchy {
 public:
  Hierarchy() = default;
  Hierarchy(const Hierarchy&) = default;
  Hierarchy(Hierarchy&& other) noexcept;
  Hierarchy& operator=(Hierarchy other) noexcept;
  ~Hierarchy() = default;

  /// Parents come before their children. @throws std::invalid_argument naming the node: a name twice, or a parent
  /// that is not an earlier node.
  explicit Hierarchy(std::vector<Node> nodes);

  /// Appends a node below an existing parent. @returns its index. @throws as the constructor.
  std::size_t add(Node node);

  /// The same for a node whose name an earlier one may have: `find` returns the latest of that name.
  std::size_t add_again(Node node);

  [[nodiscard]] std::size_t size() const noexcept { return nodes_.size(); }
  [[nodiscard]] const Node& operator[](std::size_t index) const noexcept { return nodes_[index]; }
  [[nodiscard]] std::span<const Node> nodes() const noexcept { return nodes_; }
  [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const;

  /// World motion of every node. @param local  one per node, in order  @param world  written, same size
  void world_motions(std::span<const Motion> local, std::span<WorldMotion> world) const noexcept;

  /// The frame of every node: the same bits as in the world motions. @param world  written, one per node, in order
  void world_frames(std::span<const Motion> local, std::span<WorldFrame> world) const noexcept;

  /// World motion of a single node by walking its chain of parents; the same bits as from `world_motions`.
  /// @param local_of  called with the index of each node of the chain, root first; returns its local Motion
  template <class LocalOf>
  [[nodiscard]] WorldMotion world_motion(std::size_t index, LocalOf&& local_of) const {
    constexpr std::size_t most = 64;  // longer chains are walked in stretches, so that no depth can exhaust the stack
    std::size_t depth = 0;
    for (std::size_t i = index; i != no_node; i = nodes_[i].parent) ++depth;
    WorldMotion world;
    while (depth > 0) {
      std::size_t chain[most];
      const std::size_t count = depth < most ? depth : most;
      std::size_t node = index;
      for (std::size_t skip = depth - count; skip > 0; --skip) node = nodes_[node].parent;
      for (std::size_t i = count; i > 0; --i, node = nodes_[node].parent) chain[i - 1] = node;
      depth -= count;
      for (std::size_t i = 0; i < count; ++i) world = child_of(world, local_of(chain[i]));
    }
    return world;
  }

 private:
  struct Room;                               ///< storage that may hold more nodes than one hierarchy uses
  using Names = std::vector<std::uint32_t>;  ///< nodes in order of their names
  std::shared_ptr<Room> room_;
  std::span<const Node> nodes_;                     ///< the first nodes of the room, which are its own
  std::vector<std::shared_ptr<const Names>> runs_;  ///< of all nodes, the latest last; each is longer than the next
};

}  // namespace tweenfall
