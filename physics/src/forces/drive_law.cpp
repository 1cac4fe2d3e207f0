#include "forces/drive_law.h"

#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <numbers>

namespace tweenfall::forces {

using state::Body;

DriveLaw drive_law(const Body& body, const Vec3& center, const Quat& rotation, double h, double target_ahead) {
  const double w = 2 * std::numbers::pi * body.drive.hz;
  const Vec3 arm = body.target().pose.rotation * body.mass().center;
  const Twist twist = shifted(body.target().twist, arm);
  Vec3 target = body.target().pose.position + arm;
  Quat target_rotation = body.target().pose.rotation;
  if (target_ahead > 0) {
    target -= twist.linear * target_ahead;
    target_rotation = exp_map(-twist.angular * target_ahead) * target_rotation;
  }
  DriveLaw law;
  law.stiffness = 2 * body.drive.zeta * w * h + w * h * (w * h);
  const double pull = h * w * w;
  const double damp = 2 * body.drive.zeta * w * h;
  law.linear = pull * (target - center) + damp * twist.linear;
  law.angular = pull * log_map(target_rotation * rotation.conjugate()) + damp * twist.angular;
  return law;
}

Twist pulled(const Body& body, const Load& load, Integrator integrator, double dt, bool& saturated) {
  const DriveLaw law = drive_law(body, body.center, body.motion.pose.rotation, dt, 0);
  const Vec3 unpulled = accelerated(body.twist.linear, load, integrator, dt);
  Vec3 impulse = body.mass().mass * ((unpulled + law.linear) / (1 + law.stiffness) - unpulled);
  const double most = body.drive.max_force * dt;
  saturated = impulse.norm() > most;
  if (saturated) impulse *= most / impulse.norm();

  const Quat start = body.motion.pose.rotation;
  const Vec3 spun = turned(body, {start, body.twist.angular}, load, dt).angular;
  Vec3 change = (spun + law.angular) / (1 + law.stiffness) - spun;
  const double turning = (body.world_inertia(start) * change).norm();
  const double most_turning = body.drive.max_torque * dt;
  if (turning > most_turning) {
    saturated = true;
    change *= most_turning / turning;
  }
  return {unpulled + impulse / body.mass().mass, spun + change};
}

void pull(Body& body, const Load& load, double dt) {
  body.twist = load.pulled;
  body.saturated = load.saturated;
  body.center += body.twist.linear * dt;
  Quat rotation = exp_map(body.twist.angular * dt) * body.motion.pose.rotation;
  rotation.normalize();
  body.follow_center(rotation);
}

}  // namespace tweenfall::forces
