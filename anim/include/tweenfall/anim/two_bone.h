#pragma once

/// Two bones that bend at one joint, as limbs do, so that their end reaches a target.
///
/// The chain is made once from names; `reach` then turns its start and its middle, in closed form, and gives the exact
/// angular velocities at which they turn when target and pose move. The middle bends about one axis of the start's own
/// space, one way only, so that there is a single solution and no flip between close frames.

#include <tweenfall/anim/node_ref.h>

namespace tweenfall {

/// The nodes of the chain.
struct TwoBoneSettings {
  NodeRef start;   ///< such as the thigh; it is turned
  NodeRef middle;  ///< the shin, below it; it is turned
  NodeRef end;     ///< the foot, below the middle; it reaches for the target
  /// Axis about which the middle turns when it bends, in the space of the start; any length, not along the bone. If
  /// absent, it is the one about which the rest pose is bent.
  std::optional<Vec3> axis = std::nullopt;
};

class TwoBoneChain {
 public:
  /// @throws std::invalid_argument listing what is wrong: a node that does not exist or is not below the one before;
  ///         no axis where the rest pose is straight; an axis along the bone
  TwoBoneChain(const Hierarchy& nodes, const TwoBoneSettings& settings);

  [[nodiscard]] const Hierarchy& nodes() const noexcept { return nodes_; }
  [[nodiscard]] std::size_t start() const noexcept { return start_; }
  [[nodiscard]] std::size_t middle() const noexcept { return middle_; }
  [[nodiscard]] std::size_t end() const noexcept { return end_; }
  [[nodiscard]] const Vec3& axis() const noexcept { return axis_; }  ///< unit, in the space of the start

  /// The first bone in the space of the start: x along it, y its bending axis, made perpendicular, z the third axis.
  struct Bone {
    Vec3 to_middle{0, 0, 0};  ///< m
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    double length = 0;  ///< m
    double across = 0;  ///< length of the part of `axis` across the bone; x, y and z are valid if both are above 0
  };
  [[nodiscard]] const Bone& rest_bone() const noexcept { return rest_bone_; }
  /// Whether there are no other nodes between the three.
  [[nodiscard]] bool adjacent() const noexcept { return adjacent_; }

 private:
  Hierarchy nodes_;
  std::size_t start_ = no_node, middle_ = no_node, end_ = no_node;
  Vec3 axis_{0, 0, 1};
  Bone rest_bone_;  // for poses that do not move the middle
  bool adjacent_ = false;
};

/// The goal of the end of a chain.
struct TwoBoneGoal {
  Sample<Vec3> target;  ///< place in the world, m, and its velocity
  /// World direction toward which the middle goes, away from the line to the target; any length. If absent, or along
  /// that line, the middle stays on its side in the pose, and within 1.1 degrees of the line, to either end, it goes
  /// over to the pole's side. As the middle goes all around while a pole does, somewhere it must jump: this is where a
  /// pole that near to the line is exactly opposite the side in the pose.
  std::optional<Sample<Vec3>> pole = std::nullopt;
  /// Share of the chain's length over which it slows down before it is fully stretched: 0 to 0.5. With 0 every target
  /// within reach is reached, but the bend moves infinitely fast at the limit of reach.
  double softness = 0;
};

/// Turns start and middle so that the end is at the target, or as near to it as the bones' lengths allow. Lengths of
/// bones are those of the pose; if one bone has no length, the other points at the target. Exact where scales below the
/// start are uniform. Where the target is at the start itself, the direction is that of the pose.
///
/// @param weight  0 leaves the pose as it is and 1 reaches, bit for bit; between, each joint turns part of its way
/// @param pose    local motions of all nodes; those of start and middle are changed
void reach(const TwoBoneChain& chain, const TwoBoneGoal& goal, const Sample<double>& weight,
           std::span<Motion> pose) noexcept;

/// The same where the world motion of the start's parent is known already.
void reach(const TwoBoneChain& chain, const TwoBoneGoal& goal, const Sample<double>& weight, const WorldMotion& parent,
           std::span<Motion> pose) noexcept;

}  // namespace tweenfall
