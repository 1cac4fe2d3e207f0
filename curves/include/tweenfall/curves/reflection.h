#pragma once

/// Scales that mirror.
///
/// A negative scale reflects what is below it. With the signs F of a parent's scale, its rotation P and the child's Q,
/// the whole is P F Q = P (F Q F) F: the child turns by F Q F, which is a rotation, about the reflected axis the other
/// way round. A scale that is negative along all axes, or along none, changes no rotation.

#include <tweenfall/curves/pose.h>

namespace tweenfall::pose {

[[nodiscard]] inline Vec3 signs_of(const Vec3& scale) noexcept {
  return {scale[0] < 0 ? -1.0 : 1.0, scale[1] < 0 ? -1.0 : 1.0, scale[2] < 0 ? -1.0 : 1.0};
}

/// How a reflection by the signs of a scale changes an angular velocity, or the axis of a rotation: det F times F.
[[nodiscard]] inline Vec3 reflection_of(const Vec3& scale) noexcept {
  const Vec3 signs = signs_of(scale);
  return signs[0] * signs[1] * signs[2] * signs;
}

/// F Q F. @param reflection  from `reflection_of`
[[nodiscard]] inline Quat reflected_by(const Vec3& reflection, const Quat& q) noexcept {
  return {q.w(), reflection[0] * q.x(), reflection[1] * q.y(), reflection[2] * q.z()};
}

}  // namespace tweenfall::pose
