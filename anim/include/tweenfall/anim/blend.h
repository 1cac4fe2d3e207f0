#pragma once

/// Blending whole poses: one over another, one added to another, any number by weights.
///
/// A pose is a span of motions, one for each node of a hierarchy, in order, local to the parents; each carries its
/// rates, and so does the result: exactly, including the part from moving weights. Spans of one call have one size, and
/// the output may be any of the inputs. A weight of 0 or of 1 whose rate is 0 gives the input, bit for bit; weights
/// beyond 0 and 1 extrapolate, except where stated otherwise. Accelerations of weights are not read, because a motion
/// has none. Nothing is allocated.
///
/// Rotations must be of unit length; either sign of a quaternion gives the same blend.

#include <tweenfall/anim/joint_mask.h>
#include <tweenfall/curves/pose.h>

#include <span>

namespace tweenfall {

// One over another
/// From `a` (weight 0) to `b` (weight 1), joint by joint as `mix` does it; the mask's weights multiply the weight, so a
/// mask restricts the fade to some joints.
/// @param mask for as many nodes, or of size 0 for all
void cross_fade(std::span<const Motion> a, std::span<const Motion> b, const Sample<double>& weight,
                std::span<Motion> out, const JointMask& mask = {}) noexcept;

// One added to another
/// What must be added to `reference` to get `pose`: the difference of the positions, the turn in the axes of the
/// reference, R_ref^-1 R, and the ratio of the scales. Where a scale of the reference is 0 the ratio is 1.
[[nodiscard]] Motion difference(const Motion& reference, const Motion& pose) noexcept;

/// `base` with the share `weight` of a difference added: p + w d, R D^w, and s r^w (s (1 + w (r - 1)) where the ratio
/// is not above 0, as for mirrored scales). So weight 1 takes the reference to its pose, -1 takes it back, and two
/// weights in succession do what their sum does. D^w goes the short way, at most half a turn.
[[nodiscard]] Motion add(const Motion& base, const Motion& difference, const Sample<double>& weight) noexcept;

/// The same for whole poses.
void difference(std::span<const Motion> reference, std::span<const Motion> pose, std::span<Motion> out) noexcept;
void add(std::span<const Motion> base, std::span<const Motion> difference, const Sample<double>& weight,
         std::span<Motion> out, const JointMask& mask = {}) noexcept;

// Any number by weights
/// A pose that takes part in a blend.
struct PoseLayer {
  std::span<const Motion> pose;
  Sample<double> weight{1, 0, 0};   ///< >= 0; negative ones count as 0
  const JointMask* mask = nullptr;  ///< multiplies the weight, joint by joint; none: all joints fully
};

/// Where the weights of a blend sum to less than this, the rest pose makes up the difference.
inline constexpr double least_weight = 0.1;

/// The weighted mean of poses: for each joint the weights are divided by their sum, positions and scales are mixed as
/// vectors, and rotations to the one from which the weighted rotation vectors to all of them sum to zero, as in
/// `barycentric`. Up to rounding the order does not matter; of two poses it is their cross-fade, and of one it is that
/// pose, bit for bit, whatever its weight. The rotation is unique while all lie within a quarter turn of one.
///
/// Where the weights of a joint sum to less than `least`, the rest pose gets the missing weight: a blend goes smoothly
/// to rest as the last weight fades, and weights that sum to zero give the rest pose itself. With a `least` of 1
/// weights are shares of the whole, and the rest pose always has the remainder; with 0 the rest pose is used only where
/// all weights are zero.
///
/// @param rest the rest pose, or any other pose to show through
/// @param least  >= 0
/// Source of the threshold: ozz-animation, BlendingJob; of the mean: Karcher, "Riemannian center of mass and mollifier
/// smoothing", 1977.
void blend(std::span<const PoseLayer> layers, std::span<const Motion> rest, std::span<Motion> out,
           double least = least_weight) noexcept;

}  // namespace tweenfall
