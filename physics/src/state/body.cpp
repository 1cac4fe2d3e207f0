#include "state/body.h"

namespace tweenfall::state {

Mat3 Body::world_inertia(const Quat& rotation) const {
  if (spherical()) return mass().inertia;
  const Mat3 axes = rotation.toRotationMatrix();
  return axes * mass().inertia * axes.transpose();
}

namespace {

Mat3 whole_inverse_inertia(const Body& body, const Quat& rotation) {
  if (body.spherical()) return body.inverse_inertia();
  const Mat3 axes = rotation.toRotationMatrix();
  if (body.aligned()) return axes * body.inverse_inertia().diagonal().asDiagonal() * axes.transpose();
  return axes * body.inverse_inertia() * axes.transpose();
}

/// Share of the turns out of a mirror that are left, so that the inertia has an inverse.
constexpr double hardly = 1e-9;

}  // namespace

Mat3 Body::world_inverse_inertia(const Quat& rotation) const {
  const Mat3 inverse = whole_inverse_inertia(*this, rotation);
  if (mirrored == Mirrored::in_none || spherical()) return inverse;
  if (mirrored == Mirrored::twice) return hardly * inverse;
  const Vec3 normal = mirrored == Mirrored::askew
                          ? across()
                          : Vec3(Vec3::Unit(static_cast<int>(mirrored) - static_cast<int>(Mirrored::along_x)));
  return hardly * inverse + normal.dot(inverse * normal) * normal * normal.transpose();
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
