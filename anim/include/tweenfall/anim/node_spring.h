#pragma once

/// A node whose position, rotation or both follow the script by springs: antennas, cameras, packs.

#include <tweenfall/anim/node_ref.h>
#include <tweenfall/anim/spring.h>

namespace tweenfall {

/// Writes the local motions of all nodes at a time, s. It is called for times on a spring's grid, up to one step ahead.
/// It must not throw.
using PoseAt = std::function<void(double time, std::span<Motion> pose)>;

struct NodeSpringSettings {
  NodeRef node;
  std::optional<SpringSettings> position = std::nullopt;  ///< of its position in the world
  std::optional<SpringSettings> rotation = std::nullopt;  ///< of its rotation in the world; gravity does not act on it
};

struct NodeSpringState {
  SpringState position, rotation;

  bool operator==(const NodeSpringState&) const = default;
  /// 112 bytes, those of both springs.
  [[nodiscard]] std::vector<std::byte> bytes() const;
  /// @throws std::invalid_argument for bytes that are not such a state
  [[nodiscard]] static NodeSpringState from_bytes(std::span<const std::byte> bytes);
};

class NodeSpring {
 public:
  /// @throws std::invalid_argument listing what is wrong: no such node, neither spring, settings out of range
  NodeSpring(const Hierarchy& nodes, const NodeSpringSettings& settings);

  [[nodiscard]] const Hierarchy& nodes() const noexcept { return nodes_; }
  [[nodiscard]] std::size_t node() const noexcept { return node_; }
  [[nodiscard]] const std::optional<SpringFollower>& position() const noexcept { return position_; }
  [[nodiscard]] const std::optional<SpringFollower>& rotation() const noexcept { return rotation_; }

  [[nodiscard]] NodeSpringState at_rest(double time) const noexcept;

 private:
  Hierarchy nodes_;
  std::size_t node_;
  std::optional<SpringFollower> position_, rotation_;
};

/// Advances the state to `time`, and moves the node to where its springs are then. Within a step of the grid the node's
/// path in the world is approximated by the cubic through its positions and velocities at both ends.
///
/// @param pose_at  the script
/// @param weight   0 leaves the pose's bits as they are (the springs keep moving), 1 shows the springs
/// @param scratch  as many motions as there are nodes
/// @param pose     what the script gives for `time`; the node's motion in it is changed
void follow(const NodeSpring& spring, NodeSpringState& state, double time, const PoseAt& pose_at,
            const Sample<double>& weight, std::span<Motion> scratch, std::span<Motion> pose) noexcept;

/// Restarts the clock of the springs at `time`: the position and rotation that they show, and their velocities,
/// continue, whatever the script does at that time.
///
/// @param before, after  what the script gives for `time`, as it arrives and as it leaves
/// @return their state at 0 s of the new clock
[[nodiscard]] NodeSpringState begun_anew(const NodeSpring& spring, NodeSpringState state, double time,
                                         const PoseAt& pose_at, std::span<Motion> scratch,
                                         std::span<const Motion> before, std::span<const Motion> after) noexcept;

}  // namespace tweenfall
