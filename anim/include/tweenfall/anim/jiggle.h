#pragma once

/// Chains of joints that swing behind the node that carries them: tails, hair, ropes, antennas, soft tissue.
///
/// Each joint's tail, which is the next joint, is drawn by a spring to its place in the script, is pulled by gravity,
/// and stays at its distance. The joints after it follow its swing. Like springs, chains use a grid of absolute time,
/// so that the movement is the same to the bit at every frame rate, with exact rates.

#include <tweenfall/anim/node_spring.h>

#include <numbers>

namespace tweenfall {

struct JiggleSettings {
  /// From the one nearest to the root on, each below the one before. The last is only a tail, unless it has a `tip`.
  std::vector<NodeRef> joints;
  Vec3 tip{0, 0, 0};                ///< tail of the last joint, in its own space, m; zero for none
  SpringSettings spring = {};       ///< of each joint's tail; with hz 0 only gravity acts
  double limit = std::numbers::pi;  ///< of the angle by which a joint swings away from the script, rad; 0 to pi
  double ease = 0.2;                ///< range over which it slows down before the limit, rad; >= 0
};

/// The offsets of the tails from their places in the script, at a point of the grid.
struct JiggleState {
  std::int64_t step = 0;
  std::vector<Vec3> offsets;  ///< one per swinging joint, world axes, m
  std::vector<Vec3> rates;    ///< m/s

  bool operator==(const JiggleState&) const = default;
  [[nodiscard]] std::vector<std::byte> bytes() const;
  /// @throws std::invalid_argument for bytes that are not such a state
  [[nodiscard]] static JiggleState from_bytes(std::span<const std::byte> bytes);
};

class JiggleChain {
 public:
  /// @throws std::invalid_argument listing everything that is wrong: a chain of one joint without a tip, nodes that do
  ///         not exist in the hierarchy, nodes that are not each below the one before in the chain, and settings that
  ///         are out of range
  JiggleChain(const Hierarchy& nodes, const JiggleSettings& settings);

  [[nodiscard]] const Hierarchy& nodes() const noexcept { return nodes_; }
  [[nodiscard]] const SpringFollower& spring() const noexcept { return spring_; }
  [[nodiscard]] std::span<const std::size_t> joints() const noexcept { return joints_; }  ///< those that swing
  [[nodiscard]] std::size_t tail() const noexcept { return tail_; }  ///< node after the last; `no_node` for the tip
  [[nodiscard]] const Vec3& tip() const noexcept { return tip_; }
  [[nodiscard]] double limit() const noexcept { return limit_; }
  [[nodiscard]] double ease() const noexcept { return ease_; }

  /// At the script's pose. @param time s, any finite
  [[nodiscard]] JiggleState at_rest(double time) const;
  /// Number of motions that `jiggle` needs as scratch space.
  [[nodiscard]] std::size_t scratch_size() const noexcept { return 2 * nodes_.size(); }

 private:
  Hierarchy nodes_;
  SpringFollower spring_;
  std::vector<std::size_t> joints_;
  std::size_t tail_ = no_node;
  Vec3 tip_;
  double limit_, ease_;
};

/// Advances the state to the last point of the grid up to `time`, and sets the joints to where they are at `time`. A
/// state for another number of joints, of a later time, or more than four million steps old is reset to rest.
///
/// @param pose_at  the script
/// @param weight   0 leaves the pose's bits as they are (the chain keeps swinging), 1 shows the chain
/// @param scratch  `scratch_size()` motions
/// @param pose     what the script gives for `time`; the rotations of the joints in it are changed
void jiggle(const JiggleChain& chain, JiggleState& state, double time, const PoseAt& pose_at,
            const Sample<double>& weight, std::span<Motion> scratch, std::span<Motion> pose) noexcept;

/// Restarts the chain's clock at `time`: its tails continue from where they are, with their velocities, whatever the
/// script does at that time. The state becomes that at 0 s of the new clock.
///
/// @param before, after  what the script gives for `time`, as it arrives and as it leaves
void begin_anew(const JiggleChain& chain, JiggleState& state, double time, const PoseAt& pose_at,
                std::span<Motion> scratch, std::span<const Motion> before, std::span<const Motion> after) noexcept;

}  // namespace tweenfall
