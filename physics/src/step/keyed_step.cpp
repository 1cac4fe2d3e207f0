#include "step/keyed_step.h"

#include <tweenfall/curves/rotation.h>

namespace tweenfall {

Twist displacement_rate(const Body& body, double dt) {
  if (body.fixed || !body.has_target) return {};
  const Vec3 end = body.target.pose.position + body.target.pose.rotation * body.mass.center;
  const Quat turn = body.target.pose.rotation * body.motion.pose.rotation.conjugate();
  return {(end - body.center) / dt, log_map(turn) / dt};
}

void arrive(Body& body) {
  if (body.fixed) return;
  if (body.has_target) {
    body.motion = body.target;
  } else {
    body.motion.twist = {};
    body.motion.scale_rate = Vec3::Zero();
  }
  body.has_target = false;
  body.target = body.motion;
  body.target.twist = {};
  body.follow_motion();
}

}  // namespace tweenfall
