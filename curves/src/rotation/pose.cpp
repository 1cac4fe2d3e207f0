#include <tweenfall/curves/pose.h>
#include <tweenfall/curves/reflection.h>
#include <tweenfall/curves/rotation.h>

#include "rotation/rotation_parts.h"

namespace tweenfall {

Vec3 transform_point(const Pose& pose, const Vec3& point) noexcept {
  return pose.position + pose.rotation * Vec3(pose.scale.cwiseProduct(point));
}

Pose compose(const Pose& parent, const Pose& child) noexcept {
  const Vec3 reflection = pose::reflection_of(parent.scale);
  return {transform_point(parent, child.position), parent.rotation * pose::reflected_by(reflection, child.rotation),
          parent.scale.cwiseProduct(child.scale)};
}

Motion compose(const Motion& parent, const Motion& child) noexcept {
  Motion result;
  result.pose = compose(parent.pose, child.pose);
  const Vec3 arm = result.pose.position - parent.pose.position;
  const Vec3 local =
      parent.scale_rate.cwiseProduct(child.pose.position) + parent.pose.scale.cwiseProduct(child.twist.linear);
  result.twist.linear = velocity_at(parent.twist, arm) + parent.pose.rotation * local;
  const Vec3 reflection = pose::reflection_of(parent.pose.scale);
  result.twist.angular =
      parent.twist.angular + parent.pose.rotation * Vec3(reflection.cwiseProduct(child.twist.angular));
  result.scale_rate =
      parent.scale_rate.cwiseProduct(child.pose.scale) + parent.pose.scale.cwiseProduct(child.scale_rate);
  return result;
}

Motion relative_to(const Motion& parent, const Motion& world) noexcept {
  Motion result;
  const Quat back = parent.pose.rotation.conjugate();
  const Vec3 arm = world.pose.position - parent.pose.position;
  result.pose.position = (back * arm).cwiseQuotient(parent.pose.scale);
  const Vec3 reflection = pose::reflection_of(parent.pose.scale);
  result.pose.rotation = pose::reflected_by(reflection, back * world.pose.rotation);
  result.pose.scale = world.pose.scale.cwiseQuotient(parent.pose.scale);
  const Vec3 carried = back * Vec3(world.twist.linear - velocity_at(parent.twist, arm));
  result.twist.linear =
      (carried - parent.scale_rate.cwiseProduct(result.pose.position)).cwiseQuotient(parent.pose.scale);
  result.twist.angular = reflection.cwiseProduct(back * Vec3(world.twist.angular - parent.twist.angular));
  result.scale_rate =
      (world.scale_rate - parent.scale_rate.cwiseProduct(result.pose.scale)).cwiseQuotient(parent.pose.scale);
  return result;
}

Vec3 velocity_at(const Twist& twist, const Vec3& arm) noexcept {
  return twist.linear + twist.angular.cross(arm);
}

Twist shifted(const Twist& twist, const Vec3& arm) noexcept {
  return {velocity_at(twist, arm), twist.angular};
}

Motion mix(const Motion& a, const Motion& b, double weight, double weight_rate) noexcept {
  if (weight_rate == 0) {
    if (weight == 0) return a;
    if (weight == 1) return b;
  }
  Motion result;
  result.twist.linear =
      (1 - weight) * a.twist.linear + weight * b.twist.linear + weight_rate * (b.pose.position - a.pose.position);
  result.scale_rate = (1 - weight) * a.scale_rate + weight * b.scale_rate + weight_rate * (b.pose.scale - a.pose.scale);

  // q = a exp(w r) with exp(r) = a^-1 b. In the axes of a, the rate of exp(r) is the difference of the
  // two angular velocities; the left Jacobian (that of -r) converts it to r' and back.
  const Quat back = a.pose.rotation.conjugate();
  const rotations::LogParts way(back * b.pose.rotation);
  const rotations::ExpParts turn(weight * way.r);
  const Vec3 difference = back * Vec3(b.twist.angular - a.twist.angular);
  const Vec3 turning = turn.left(weight_rate * way.r + weight * way.left_inverse(difference));
  result.twist.angular = a.twist.angular + a.pose.rotation * turning;

  // The ends are the inputs themselves, whatever the rate.
  if (weight == 0) {
    result.pose = a.pose;
  } else if (weight == 1) {
    result.pose = b.pose;
  } else {
    result.pose.position = (1 - weight) * a.pose.position + weight * b.pose.position;
    result.pose.scale = (1 - weight) * a.pose.scale + weight * b.pose.scale;
    const Quat& near = weight < 0.5 ? a.pose.rotation : b.pose.rotation;
    result.pose.rotation = hemisphere_aligned(a.pose.rotation * turn.rotation, near);
  }
  return result;
}

}  // namespace tweenfall
