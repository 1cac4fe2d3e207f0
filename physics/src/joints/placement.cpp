#include "joints/placement.h"

namespace tweenfall::joints {

Placement placement_of(const JointSettings& joint, const Vec3& center_a, const Quat& rotation_a,
                       const Vec3& mass_center_a, const Vec3& center_b, const Quat& rotation_b,
                       const Vec3& mass_center_b) {
  return {center_a,
          center_b,
          rotation_a * (joint.frame_a.position - mass_center_a),
          rotation_b * (joint.frame_b.position - mass_center_b),
          rotation_a * joint.frame_a.rotation,
          rotation_b * joint.frame_b.rotation,
          {},
          {}};
}

Placement placement_in(const state::Joint& joint, const std::vector<state::Body>& bodies) {
  const JointSettings& settings = joint.settings;
  const state::Body& b = bodies[settings.b.index];
  if (settings.a == BodyId{})
    return placement_of(settings, Vec3(0, 0, 0), Quat(1, 0, 0, 0), Vec3(0, 0, 0), b.center, b.motion.pose.rotation,
                        b.mass().center);
  const state::Body& a = bodies[settings.a.index];
  return placement_of(settings, a.center, a.motion.pose.rotation, a.mass().center, b.center, b.motion.pose.rotation,
                      b.mass().center);
}

}  // namespace tweenfall::joints
