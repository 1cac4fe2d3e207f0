#pragma once

/// A joint that looks at a target, or a chain of joints that share the turning: heads, eyes, turrets, spines.
///
/// The last joint is the one that looks; those before it do part of the turning, as a spine and a neck do. How far it
/// turns away from the pose itself may be limited; it slows down toward the limit, and releases a target that comes
/// directly behind, so that nothing snaps from one side to the other.

#include <tweenfall/anim/node_ref.h>

#include <numbers>
#include <vector>

namespace tweenfall {

struct LookAtJoint {
  NodeRef node;
  double share = 1;  ///< of the turning that the joints before it left over, 0 to 1
};

struct LookAtSettings {
  std::vector<LookAtJoint> joints;  ///< from the one nearest to the root to the one that looks, at least one
  Vec3 forward{0, 0, 1};            ///< where the last joint looks, in its own space; any length
  Vec3 up{0, 1, 0};                 ///< the up direction in its own space; used where a goal has an up too
  Vec3 eye{0, 0, 0};                ///< from where it looks, in its own space, m
  double limit = std::numbers::pi;  ///< angle between the pose's direction and the final one, rad; 0 to pi
  double ease = 0.2;                ///< range over which it slows down before the limit, rad; >= 0
};

class LookAtChain {
 public:
  /// @throws std::invalid_argument listing what is wrong: no joint, nodes that do not exist or do not stand below each
  ///         other, a share or an angle out of range, a forward or up of no length, or both along one line
  LookAtChain(const Hierarchy& nodes, const LookAtSettings& settings);

  struct Joint {
    std::size_t node;
    double share;
  };

  [[nodiscard]] const Hierarchy& nodes() const noexcept { return nodes_; }
  [[nodiscard]] std::span<const Joint> joints() const noexcept { return joints_; }
  [[nodiscard]] const Vec3& forward() const noexcept { return forward_; }  ///< unit
  [[nodiscard]] const Vec3& up() const noexcept { return up_; }            ///< unit, perpendicular to forward
  [[nodiscard]] const Vec3& eye() const noexcept { return eye_; }
  [[nodiscard]] double limit() const noexcept { return limit_; }
  [[nodiscard]] double ease() const noexcept { return ease_; }

 private:
  Hierarchy nodes_;
  std::vector<Joint> joints_;
  Vec3 forward_, up_, eye_;
  double limit_, ease_;
};

struct LookAtGoal {
  Sample<Vec3> target;  ///< place in the world, m, and its velocity
  /// World direction for `up`; if absent, or along the line of sight, the joints turn the shortest way. A joint that
  /// does only its share of the turning lets go of an up that is nearly opposite its own. As the up goes all around
  /// while the line of sight does so about it, somewhere it must jump: this is within 3 degrees of the up, to either
  /// end, where the up is exactly opposite that of the pose.
  std::optional<Sample<Vec3>> up = std::nullopt;
};

/// Turns the joints so that the last one, if its share is 1 and the limit allows it, looks at the target from its eye,
/// exactly. A target at the joint itself leaves the pose as it is. Exact where scales are uniform, mirrored or not.
///
/// @param weight  0 leaves the pose as it is and 1 looks, bit for bit; between, each joint turns part of its way
/// @param pose    local motions of all nodes; those of the joints are changed
void look_at(const LookAtChain& chain, const LookAtGoal& goal, const Sample<double>& weight,
             std::span<Motion> pose) noexcept;

}  // namespace tweenfall
