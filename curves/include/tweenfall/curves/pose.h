#pragma once

/// Where a thing is and how it moves: `Pose`, `Twist`, and both together, `Motion`.
///
/// Poses compose like transforms, parent on the left; motions compose the same way and
/// carry their rates along, exactly: the rate of a product is the product rule, not a
/// difference of two frames.

#include <tweenfall/curves/values.h>

namespace tweenfall {

/// A placement: scale first, then rotation, then translation.
struct Pose {
  Vec3 position{0, 0, 0};     ///< meters
  Quat rotation{1, 0, 0, 0};  ///< unit; Eigen's constructor takes w, x, y, z
  Vec3 scale{1, 1, 1};        ///< factors along the local axes
};

/// Linear and angular velocity of one point of a thing, in the axes of the space the pose maps into.
struct Twist {
  Vec3 linear{0, 0, 0};   ///< m/s, of the pose's origin unless said otherwise
  Vec3 angular{0, 0, 0};  ///< rad/s
};

/// A pose and its exact rates.
struct Motion {
  Pose pose;
  Twist twist;
  Vec3 scale_rate{0, 0, 0};  ///< 1/s
};

/// `point`, given in the space of `pose`, seen from outside.
[[nodiscard]] Vec3 transform_point(const Pose& pose, const Vec3& point) noexcept;

/// The pose that applies `child` first, then `parent`. Exact while the parent's scale is uniform but for signs, which
/// mirror the child's turn, or the child is not rotated; shear, which a pose cannot hold, is dropped.
[[nodiscard]] Pose compose(const Pose& parent, const Pose& child) noexcept;

/// The same for motions: poses compose, rates follow by the product rule.
[[nodiscard]] Motion compose(const Motion& parent, const Motion& child) noexcept;

/// The motion `x` for which `compose(parent, x)` is `world`; scales of `parent` must not be zero.
[[nodiscard]] Motion relative_to(const Motion& parent, const Motion& world) noexcept;

/// Velocity of the material point at `arm` (world axes, from the twist's own point):
/// v + w x r, rigid part only.
[[nodiscard]] Vec3 velocity_at(const Twist& twist, const Vec3& arm) noexcept;

/// The same rigid movement, expressed about the point `arm` away: linear v + w x r, angular unchanged.
[[nodiscard]] Twist shifted(const Twist& twist, const Vec3& arm) noexcept;

/// Mixes two motions: weight 0 gives `a`, 1 gives `b`, bit for bit; between, position and
/// scale are mixed linearly and rotation along the shortest arc.
///
/// @param weight       0 to 1
/// @param weight_rate  derivative of the weight, 1/s; enters the rates exactly:
///                     x' = (1-w)a' + w b' + w'(b-a), and its analogue for rotations
[[nodiscard]] Motion mix(const Motion& a, const Motion& b, double weight, double weight_rate) noexcept;

}  // namespace tweenfall
