#pragma once

// The inner loops of blending, adding and placing, one version for each instruction set.

#include <tweenfall/anim/crowd_kernels.h>

#include <span>

namespace tweenfall::crowd {

/// Weights up to this count as none, for floats do not hold the inverse of the smallest.
inline constexpr float least_weight = 1e-30F;

struct PoseKernels {
  /// Layers without masks, the first of which has a weight. @param portion factor that makes the weights sum to 1
  void (*blend)(const CrowdLayer* layers, std::size_t layer_count, float portion, std::size_t groups, CrowdGroup* out);
  void (*blend_masked)(const CrowdLayer* layers, std::size_t layer_count, std::size_t groups, CrowdGroup* out);
  void (*difference)(const CrowdGroup* reference, const CrowdGroup* pose, std::size_t groups, CrowdGroup* out);
  void (*add)(const CrowdGroup* base, const CrowdGroup* difference, float weight, const float* mask, std::size_t groups,
              CrowdGroup* out);
  /// Matrices relative to the parents. @param joints in the last group only existing joints are written
  void (*place)(const CrowdGroup* pose, std::size_t joints, CrowdMatrix* out);
  /// out[j] = out[parents[j]] out[j] in the given order; `root` is used for parents beyond the joints.
  void (*compose)(const std::uint32_t* order, const std::uint32_t* parents, std::size_t joints, const CrowdMatrix& root,
                  CrowdMatrix* out);
};

/// For all instruction sets that this processor has, the plainest first. All give the same bits.
[[nodiscard]] std::span<const PoseKernels* const> possible_pose_kernels();
/// The last of them.
[[nodiscard]] const PoseKernels& fastest_pose_kernels();

void blend_with(const PoseKernels& kernels, std::span<const CrowdLayer> layers, std::span<CrowdGroup> out) noexcept;
void add_with(const PoseKernels& kernels, std::span<const CrowdGroup> base, std::span<const CrowdGroup> difference,
              float weight, std::span<CrowdGroup> out, std::span<const float> mask) noexcept;

}  // namespace tweenfall::crowd
