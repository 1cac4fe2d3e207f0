#pragma once

// Rotations together with how they move, in their own (turned) axes, in which the rates of exponentials, logarithms and
// mixes are short formulas.

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

/// The part of the acceleration that does not come from r'': acceleration = J(r) r'' + this.
[[nodiscard]] Vec3 bent_acceleration(const Vec3& r, const Vec3& first) noexcept;

/// Rotation vector along the way given by the sign of the quaternion: length 0 to 2 pi, more than pi where w < 0.
[[nodiscard]] Vec3 signed_log(const Quat& q) noexcept;

/// With its derivatives; at a whole turn these are infinite and are returned as zero.
[[nodiscard]] MovingVector signed_log(const MovingRotation& q) noexcept;

/// a b
[[nodiscard]] MovingRotation product(const MovingRotation& a, const MovingRotation& b) noexcept;

/// a^-1 b
[[nodiscard]] MovingRotation quotient(const MovingRotation& a, const MovingRotation& b) noexcept;

/// a exp(w log(a^-1 b)), by `signed_log`.
[[nodiscard]] MovingRotation mixed(const MovingRotation& a, const MovingRotation& b, const MovingWeight& w) noexcept;

}  // namespace tweenfall::rotations
