#pragma once

// Composition below scales that mirror.
//
// A negative scale reflects what is below it. With the signs F of the parent's scale, its rotation P and the child's Q,
// the whole is P F Q = P (F Q F) F: the child turns by F Q F, which is a rotation, about the reflected axis the other
// way round. Without negative scales all is as by `compose` and `relative_to`, bit for bit.

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

[[nodiscard]] inline Quat reflected_by(const Vec3& reflection, const Quat& q) noexcept {
  return {q.w(), reflection[0] * q.x(), reflection[1] * q.y(), reflection[2] * q.z()};
}

[[nodiscard]] inline Pose reflected_by(const Vec3& reflection, Pose pose) noexcept {
  pose.rotation = reflected_by(reflection, pose.rotation);
  return pose;
}

[[nodiscard]] inline Motion reflected_by(const Vec3& reflection, Motion motion) noexcept {
  motion.pose = reflected_by(reflection, motion.pose);
  motion.twist.angular = reflection.cwiseProduct(motion.twist.angular);
  return motion;
}

[[nodiscard]] inline Pose compose_reflected(const Pose& parent, const Pose& child) noexcept {
  return compose(parent, reflected_by(reflection_of(parent.scale), child));
}

[[nodiscard]] inline Motion compose_reflected(const Motion& parent, const Motion& child) noexcept {
  return compose(parent, reflected_by(reflection_of(parent.pose.scale), child));
}

/// The motion `x` for which `compose_reflected(parent, x)` is `world`; scales of `parent` must not be zero.
[[nodiscard]] inline Motion relative_to_reflected(const Motion& parent, const Motion& world) noexcept {
  return reflected_by(reflection_of(parent.pose.scale), relative_to(parent, world));
}

}  // namespace tweenfall::pose
