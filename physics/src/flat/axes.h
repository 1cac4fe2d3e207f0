#pragma once

#include <tweenfall/curves/elementary.h>
#include <tweenfall/physics/planar_world.h>

namespace tweenfall::flat {

/// Two axes of space as those of a plane; the third is its normal.
struct Axes {
  int first = 0, second = 1, normal = 2;
  double sign = 1;  ///< of a turn about the normal's axis that takes the first to the second

  [[nodiscard]] static Axes of(WorldPlane plane) {
    if (plane == WorldPlane::xz) return {0, 2, 1, -1};
    if (plane == WorldPlane::yz) return {1, 2, 0, 1};
    return {};
  }
  [[nodiscard]] Vec2 flat(const Vec3& v) const { return {v[first], v[second]}; }
  [[nodiscard]] Vec3 space(const Vec2& v) const {
    Vec3 all(0, 0, 0);
    all[first] = v.x();
    all[second] = v.y();
    return all;
  }
  [[nodiscard]] Vec3 space(double spin) const {
    Vec3 all(0, 0, 0);
    all[normal] = sign * spin;
    return all;
  }
  /// Within half a turn.
  [[nodiscard]] double angle(const Quat& rotation) const {
    const Quat q = rotation.w() < 0 ? Quat(-rotation.w(), -rotation.x(), -rotation.y(), -rotation.z()) : rotation;
    return 2 * sign * elementary::atan2(q.vec()[normal], q.w());
  }
  [[nodiscard]] Quat rotation(double angle) const {
    const elementary::SinCos half = elementary::sin_cos(0.5 * angle);
    Quat q(half.cos, 0, 0, 0);
    q.vec()[normal] = sign * half.sin;
    return q;
  }
  [[nodiscard]] planar::Motion flat(const Motion& motion) const {
    return {flat(motion.pose.position), angle(motion.pose.rotation), flat(motion.twist.linear),
            sign * motion.twist.angular[normal]};
  }
};

}  // namespace tweenfall::flat
