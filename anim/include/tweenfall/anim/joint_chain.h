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
/// farther the target is, the more they start from the middle of their limits. Close targets have close results here
/// too, except where what is nearest itself changes sides, as for a finger whose target goes around behind it. The
/// poses that limits allow may form separate branches, as for an elbow that can bend to one side or the other: then no
/// rule can both come as near as possible to all targets and never jump. The chain reaches the targets on the branch on
/// which it begins: for random chains of sockets 9,999 in 10,000 of all that can be reached, of hinges and sockets 997
/// in 1,000, of hinges about arbitrary axes 97 in 100. To the others it comes near on that branch: of random targets
/// out of reach to three in four as near as any pose does, to 1e-6 of the chain's length, and to seven in eight within
/// 0.001 of that. With `leaps` it also searches elsewhere, from poses drawn within the limits, the same ones each time:
/// of 10,000 random chains of any of these it misses one at most, and it comes as near as any pose does to what cannot
/// be reached (of 1,000 random targets to all but 4, which it misses by up to 0.01 of the chain's length more). Then it
/// jumps wherever another branch is nearer, and a target that cannot be reached takes about a hundred times as long,
/// some milliseconds to tens of them. A chain that remembers where it was reaches all of them, and leaps only where it
/// must (following_chain.h).

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
  int sweeps = 8;      ///< 0 to 1000
  bool leaps = false;  ///< whether a chain with limits may jump to where it is nearer to its target
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
