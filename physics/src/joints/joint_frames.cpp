#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/joint.h>

#include <Eigen/Geometry>
#include <stdexcept>

namespace tweenfall {

namespace joints {
namespace {

/// The same direction with a greatest component of 1, so that no square overflows; or zero.
Vec3 scaled(const Vec3& direction) {
  const double most = direction.cwiseAbs().maxCoeff();
  return most > 0 ? Vec3(direction / most) : Vec3(0, 0, 0);
}

}  // namespace
}  // namespace joints

JointFrames joint_frames(const Pose& a, const Pose& b, const Vec3& point, const Vec3& axis, const Vec3& second) {
  if (!point.allFinite() || !axis.allFinite() || !second.allFinite())
    throw std::invalid_argument("point and axes of a joint must be finite");
  const Vec3 along = joints::scaled(axis), across = joints::scaled(second);
  if (along == Vec3::Zero()) throw std::invalid_argument("the axis of a joint must have a length");
  const Vec3 x = along / along.norm();
  Vec3 y = across - x * x.dot(across);
  if (!(y.norm() > 1e-9 * across.norm())) {
    // The axis of the world that is farthest from x.
    Vec3::Index least = 0;
    x.cwiseAbs().minCoeff(&least);
    y = Vec3::Unit(least) - x * x[least];
  }
  y /= y.norm();
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
