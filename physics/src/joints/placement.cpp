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

}  // namespace tweenfall::joints
