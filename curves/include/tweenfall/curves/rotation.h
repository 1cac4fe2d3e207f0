#pragma once

/// Rotations: the exponential and logarithm that tie them to angular velocity, Euler angles
/// in all twelve orders, and the shortest-arc interpolation between two.

#include <tweenfall/curves/values.h>

#include <span>

namespace tweenfall {

/// Rotation by |v| radians about v. Series near zero; exact identity at 0.
[[nodiscard]] Quat exp_map(const Vec3& rotation_vector) noexcept;

/// Rotation vector of `q`, the shortest: length 0 to pi. Inverse of `exp_map` there.
[[nodiscard]] Vec3 log_map(const Quat& q) noexcept;

/// Right Jacobian of the exponential: with q(t) = exp(r(t)), the angular velocity in the
/// rotated (body) axes is J(r) r'. Its inverse goes back, for |r| < 2 pi.
/// Source: Chirikjian, Stochastic Models, Information Theory, and Lie Groups 2, 2012, eq. 10.86.
[[nodiscard]] Mat3 right_jacobian(const Vec3& r) noexcept;
[[nodiscard]] Mat3 right_jacobian_inverse(const Vec3& r) noexcept;

/// `q` or `-q`, whichever is nearer to `reference`.
[[nodiscard]] Quat hemisphere_aligned(const Quat& q, const Quat& reference) noexcept;

/// Constant-speed shortest arc from `a` (u = 0) to `b` (u = 1); a and b exactly at the ends.
[[nodiscard]] Quat slerp(const Quat& a, const Quat& b, double u) noexcept;

/// `q` scaled to unit length. @throws std::invalid_argument for a zero or non-finite quaternion.
[[nodiscard]] Quat normalized(const Quat& q);

/// The mean of rotations that does not depend on their order or signs: the unit quaternion q with the largest
/// sum of weight (q . q_i)^2. Of q and -q, the one nearer to the first rotation is returned.
///
/// @param rotations  unit quaternions
/// @param weights    one per rotation, >= 0, not all zero; only their ratios matter
/// @throws std::invalid_argument naming the rotation: none, sizes that differ, a weight that is negative or not finite,
///         all weights zero, a rotation that is not of unit length to 1e-6.
/// Source: Markley, Cheng, Crassidis, Oshman, "Averaging quaternions", 2007.
[[nodiscard]] Quat weighted_mean(std::span<const Quat> rotations, std::span<const double> weights);

/// Axes in the order in which they are applied. Intrinsic (`xyz`): each turn about the
/// already turned axis, R = X Y Z. Extrinsic: about the fixed axes, R = Z Y X.
struct EulerOrder {
  int axes[3] = {0, 1, 2};  ///< 0, 1, 2 for x, y, z; neighbors differ
  bool intrinsic = true;

  bool operator==(const EulerOrder&) const = default;
};

/// @param angles  radians, in the order's sequence of axes
[[nodiscard]] Quat from_euler(const Vec3& angles, const EulerOrder& order = {}) noexcept;

/// Angles in the order's sequence; at gimbal lock the third is 0.
[[nodiscard]] Vec3 to_euler(const Quat& q, const EulerOrder& order = {}) noexcept;

/// The same with rates: moving angles as a moving rotation, and back. Where the axes of the first and third angle
/// coincide (gimbal lock), the third angle is 0, and so are its rates.
[[nodiscard]] Sample<Quat> from_euler(const Sample<Vec3>& angles, const EulerOrder& order = {}) noexcept;
[[nodiscard]] Sample<Vec3> to_euler(const Sample<Quat>& rotation, const EulerOrder& order = {}) noexcept;

/// a b, with its rates: b turns within a.
[[nodiscard]] Sample<Quat> product(const Sample<Quat>& a, const Sample<Quat>& b) noexcept;

/// The rotation that undoes `q`, with its rates.
[[nodiscard]] Sample<Quat> inverse(const Sample<Quat>& q) noexcept;

/// From a (weight 0) along the shorter arc to b (weight 1), all three moving.
[[nodiscard]] Sample<Quat> slerp(const Sample<Quat>& a, const Sample<Quat>& b, const Sample<double>& weight) noexcept;

}  // namespace tweenfall
