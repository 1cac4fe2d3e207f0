#pragma once

// A chain in one pose, while it is being turned, in the space of the first joint's parent.

#include "chains/joint_limits.h"

namespace tweenfall::chains {

class ChainShape {
 public:
  static constexpr std::size_t room = JointChain::most_joints;

  /// The chain in the given pose, brought within its limits.
  ChainShape(const JointChain& chain, std::span<const Motion> pose) noexcept;

  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  [[nodiscard]] const JointChain::Joint& joint(std::size_t i) const noexcept { return chain_->joints()[i]; }
  /// Places of the joints and, last, of the end.
  [[nodiscard]] const Arrow& at(std::size_t i) const noexcept { return at_[i]; }
  [[nodiscard]] const Arrow& end() const noexcept { return at_[count_]; }
  [[nodiscard]] Arrow bone(std::size_t i) const noexcept { return own_[i] * bone_[i]; }
  [[nodiscard]] const Dual& length(std::size_t i) const noexcept { return length_[i]; }
  /// The sum of the bones' lengths.
  [[nodiscard]] const Dual& reach() const noexcept { return reach_; }

  /// How a joint is turned from rest, in the axes of its rest pose.
  [[nodiscard]] const Turning& turn(std::size_t i) const noexcept { return turn_[i]; }
  /// The rotation of a joint, in the axes of its parent.
  [[nodiscard]] Turning local(std::size_t i) const noexcept {
    return reflected_by(reflection_[i], fixed_[i] * turn_[i]);
  }
  /// Converts a direction from the common space to the axes of the joint's turn, and back.
  [[nodiscard]] Arrow inside(std::size_t i, const Arrow& a) const noexcept { return inverse(outer_[i]) * a; }
  [[nodiscard]] Arrow outside(std::size_t i, const Arrow& a) const noexcept { return outer_[i] * a; }

  /// The rotation from the axes of the joint before, or from the common space, to those of the joint's rest pose.
  [[nodiscard]] Turning before(std::size_t i) const noexcept { return between_[i] * fixed_[i]; }
  /// From a joint to the next, in its own axes.
  [[nodiscard]] const Arrow& arm(std::size_t i) const noexcept { return bone_[i]; }

  /// Turns one joint and moves nothing; `place` follows.
  void turn(std::size_t i, const Turning& turn) noexcept { turn_[i] = turn; }
  /// Places only joint `i`, and the next one's axes and position.
  void place_one(std::size_t i) noexcept;
  /// Places all from `from` on.
  void place(std::size_t from = 0) noexcept;
  /// Turns a joint so that the direction `from` comes toward `to`, as far as its limits allow; moves all it carries.
  void aim(std::size_t i, const Arrow& from, const Arrow& to) noexcept;

 private:
  const JointChain* chain_;
  std::size_t count_;
  Dual reach_;
  Vec3 reflection_[room];  // of a joint by the scales above it in the chain: all but `local` is as without
  Arrow bone_[room];       // to the next joint, in the joint's own axes, scaled
  Dual length_[room];
  Turning between_[room];            // from the own axes of the joint before to those of the parent
  Turning fixed_[room];              // rest rotation
  Turning turn_[room];               // from rest, in the axes of the rest pose
  Turning outer_[room], own_[room];  // of the rest pose and of the joint, in the common space
  Arrow at_[room + 1];               // joints and the end
};

}  // namespace tweenfall::chains
