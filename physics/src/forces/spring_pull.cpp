#include "forces/spring_pull.h"

namespace tweenfall::forces {

using state::Body;

Glimpse now(const Body& body) {
  return {body.center, body.twist.linear, body.twist.angular, body.motion.pose.rotation};
}

Pull pull_of(const Spring& spring, const Body& body_a, const Glimpse& a, const Body* body_b, const Glimpse& b) {
  Pull pull;
  pull.arm_a = a.rotation * (spring.anchor_a - body_a.mass().center);
  pull.arm_b = body_b ? Vec3(b.rotation * (spring.anchor_b - body_b->mass().center)) : Vec3(0, 0, 0);
  const Vec3 end_a = a.center + pull.arm_a;
  const Vec3 end_b = body_b ? Vec3(b.center + pull.arm_b) : spring.anchor_b;
  const Vec3 between = end_b - end_a;
  const double length = between.norm();
  if (length == 0) {
    pull.force = Vec3::Zero();
    return pull;
  }
  const Vec3 direction = between / length;
  const Vec3 velocity_a = a.linear + a.angular.cross(pull.arm_a);
  const Vec3 velocity_b = body_b ? Vec3(b.linear + b.angular.cross(pull.arm_b)) : Vec3(0, 0, 0);
  const double stretching = direction.dot(velocity_b - velocity_a);
  pull.force = direction * (spring.stiffness * (length - spring.rest_length) + spring.damping * stretching);
  return pull;
}

}  // namespace tweenfall::forces
