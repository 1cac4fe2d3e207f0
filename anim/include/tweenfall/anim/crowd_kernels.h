#pragma once

/// Operations on poses of a crowd: blending, adding, and from local to world; each for eight joints at
/// once.
///
/// A pose is a span of groups, as many as its joints take; spans of one call have one size, and the output may be any
/// of the inputs. Each call handles one figure and touches only its spans, so a crowd is shared among threads by giving
/// each of them some figures: `each_of_crowd` divides it for any loop of the caller's. Nothing is allocated, and the
/// bits are the same on every processor and for every division.

#include <tweenfall/anim/crowd.h>
#include <tweenfall/anim/crowd_pose.h>
#include <tweenfall/anim/hierarchy.h>
#include <tweenfall/anim/joint_mask.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tweenfall {

// Masks
/// The weights of a mask lane by lane, as the kernels need them; 0 in the lanes beyond the last joint.
/// @throws std::invalid_argument where the size of the mask is neither 0 nor `joints`.
[[nodiscard]] std::vector<float> crowd_mask(const JointMask& mask, std::size_t joints);

// Blending
/// A pose that takes part in a blend.
struct CrowdLayer {
  std::span<const CrowdGroup> pose;
  float weight = 1;               ///< up to 1e30; what is at most 1e-30, with its mask, counts as 0
  std::span<const float> mask{};  ///< from `crowd_mask`: multiplies the weight, joint by joint; empty: all fully
};

/// The weighted mean of one or more poses: for each joint the weights are divided by their sum; rotations are summed as
/// quaternions in the hemisphere of the first layer's, and normalized. Where only one layer has a weight for a joint,
/// its numbers are taken bit for bit; where none has, those of the first layer.
void blend(std::span<const CrowdLayer> layers, std::span<CrowdGroup> out) noexcept;

// One added to another
/// What must be added to `reference` to get `pose`: the difference of the translations, the turn R_ref^-1 R, and the
/// ratio of the scales, 1 where a scale of the reference is 0.
void difference(std::span<const CrowdGroup> reference, std::span<const CrowdGroup> pose,
                std::span<CrowdGroup> out) noexcept;

/// `base` with the share `weight` of a difference added: p + w d, R D_w and s (1 + w (r - 1)), where D_w is the
/// normalized mix of the identity and the turn, the short way. Weight 0 gives the base, bit for bit.
/// @param mask  from `crowd_mask`: multiplies the weight, joint by joint; empty: all fully
void add(std::span<const CrowdGroup> base, std::span<const CrowdGroup> difference, float weight,
         std::span<CrowdGroup> out, std::span<const float> mask = {}) noexcept;

// Local to world
/// A transform to the world: three rows of a matrix with a fourth row of 0, 0, 0, 1; the last column is the origin.
struct alignas(16) CrowdMatrix {
  float row[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
};

/// The parents of a figure's joints.
class CrowdSkeleton {
 public:
  explicit CrowdSkeleton(const Hierarchy& nodes);

  [[nodiscard]] std::size_t joints() const noexcept { return parents_.size(); }

  /// The world transform of every joint, including scale and shear of all joints above it.
  /// @param pose   `crowd_groups(joints())` of them
  /// @param world  written; one for each joint
  /// @param root transform of the figure
  void local_to_world(std::span<const CrowdGroup> pose, std::span<CrowdMatrix> world,
                      const CrowdMatrix& root = {}) const noexcept;

 private:
  static constexpr std::uint32_t outside = 0xffffffff;

  std::vector<std::uint32_t> parents_;
  std::vector<std::uint32_t> order_;  // grouped by depth, so that neighbors do not depend on each other
};

// Many figures
/// Calls `work(i)` for each i below `count`, grouped into parts of several each.
/// @param for_each  the caller's loop: `for_each(parts, part)` calls `part(p)` once for each p below `parts`, in any
///                  order and on any threads, and returns when all have been done
template <class ForEach, class Work>
void each_of_crowd(std::size_t count, ForEach&& for_each, const Work& work) {
  constexpr std::size_t figures_of_part = 16;
  for_each((count + figures_of_part - 1) / figures_of_part, [&](std::size_t part) {
    const std::size_t end = std::min(count, (part + 1) * figures_of_part);
    for (std::size_t i = part * figures_of_part; i < end; ++i) work(i);
  });
}

}  // namespace tweenfall
