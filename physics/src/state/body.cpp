#include "state/body.h"

namespace tweenfall::state {

Mat3 Body::world_inertia(const Quat& rotation) const {
  if (spherical()) return mass().inertia;
  const Mat3 axes = rotation.toRotationMatrix();
  return axes * mass().inertia * axes.transpose();
}

Mat3 Body::world_inverse_inertia(const Quat& rotation) const {
  if (spherical()) return inverse_inertia();
  const Mat3 axes = rotation.toRotationMatrix();
  if (aligned()) return axes * inverse_inertia().diagonal().asDiagonal() * axes.transpose();
  return axes * inverse_inertia() * axes.transpose();
}

void Body::set_filter(const Filter& its) {
  // Bodies that meet all others have none, so that a world of many bodies stays small.
  if (its == Filter{})
    filter.reset();
  else
    filter.own() = its;
}

void Body::follow_motion() {
  const Vec3 arm = motion.pose.rotation * mass().center;
  center = motion.pose.position + arm;
  twist = shifted(motion.twist, arm);
}

void Body::follow_center(const Quat& rotation) {
  const Vec3 arm = rotation * mass().center;
  motion.pose.rotation = rotation;
  motion.pose.position = center - arm;
  motion.twist = shifted(twist, -arm);
}

}  // namespace tweenfall::state
