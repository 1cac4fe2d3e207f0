#pragma once

// Rotations together with how they move, in their own (turned) axes: there exponentials, logarithms and mixes
// have short rates.

#include <tweenfall/curves/values.h>

namespace tweenfall::rotations {

struct MovingRotation {
  Quat value;
  Vec3 velocity, acceleration;  ///< in the axes of the value
};

/// A rotation vector with its first and second derivative.
struct MovingVector {
  Vec3 value, first, second;
};

/// A number with its first and second derivative.
struct MovingWeight {
  double value, first, second;
};

[[nodiscard]] MovingRotation inner(const Sample<Quat>& sample) noexcept;
[[nodiscard]] Sample<Quat> outer(const MovingRotation& moving) noexcept;

[[nodiscard]] MovingRotation exponential(const MovingVector& r) noexcept;

/// A rotation and its angular velocity alone, in the axes of the value.
struct TurningRotation {
  Quat value;
  Vec3 velocity;
};

/// The same without the acceleration, to the bit.
[[nodiscard]] TurningRotation exponential(const Vec3& r, const Vec3& first) noexcept;

/// What the second derivative of the logarithm lacks: acceleration = J(r) r'' + this.
[[nodiscard]] Vec3 bent_acceleration(const Vec3& r, const Vec3& first) noexcept;

/// Rotation vector on the way that the sign of the quaternion says: length 0 to 2 pi, more than pi where w < 0.
[[nodiscard]] Vec3 signed_log(const Quat& q) noexcept;

/// Its derivatives too; they are infinite at a whole turn, where they count as zero.
[[nodiscard]] MovingVector signed_log(const MovingRotation& q) noexcept;

/// a b
[[nodiscard]] MovingRotation product(const MovingRotation& a, const MovingRotation& b) noexcept;

/// a^-1 b
[[nodiscard]] MovingRotation quotient(const MovingRotation& a, const MovingRotation& b) noexcept;

/// a exp(w log(a^-1 b)), by `signed_log`.
[[nodiscard]] MovingRotation mixed(const MovingRotation& a, const MovingRotation& b, const MovingWeight& w) noexcept;

}  // namespace tweenfall::rotations
