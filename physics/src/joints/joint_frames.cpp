#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/joint.h>

#include <Eigen/Geometry>
#include <stdexcept>

namespace tweenfall {

JointFrames joint_frames(const Pose& a, const Pose& b, const Vec3& point, const Vec3& axis, const Vec3& second) {
  if (!point.allFinite() || !axis.allFinite() || !second.allFinite())
    throw std::invalid_argument("point and axes of a joint must be finite");
  const double length = axis.stableNorm();
  if (!(length > 0)) throw std::invalid_argument("the axis of a joint must have a length");
  const Vec3 x = axis / length;
  Vec3 y = second - x * x.dot(second);
  if (!(y.stableNorm() > 1e-9 * second.stableNorm())) {
    // The axis of the world that lies farthest off x.
    Vec3::Index least = 0;
    x.cwiseAbs().minCoeff(&least);
    y = Vec3::Unit(least) - x * x[least];
  }
  y.stableNormalize();
  Mat3 axes;
  axes << x, y, x.cross(y);
  const Quat rotation = normalized(Quat(axes));
  const auto seen_from = [&](const Pose& node) {
    const Quat back = node.rotation.conjugate();
    return Pose{back * (point - node.position), normalized(back * rotation)};
  };
  return {seen_from(a), seen_from(b)};
}

}  // namespace tweenfall
