#include <tweenfall/anim/root_motion.h>

#include <cmath>
#include <stdexcept>

#include "pose/joint_names.h"
#include "pose/rest.h"

namespace tweenfall {

namespace pose {
namespace {

// Keeps only the part of a turn about `up`, with its angular velocity: of the quaternion (w, v) this is (w, u up),
// normalized, with u = v . up. The identity where that has no length, as for half a turn about a horizontal axis.
void keep_yaw(Motion& turn, const Vec3& up) noexcept {
  const Quat& q = turn.pose.rotation;
  const Vec3 v = q.vec(), spin = turn.twist.angular;
  const double w = q.w(), u = v.dot(up), square = w * w + u * u;
  if (!(square > 1e-30)) {
    turn.pose.rotation = {1, 0, 0, 0};
    turn.twist.angular = {0, 0, 0};
    return;
  }
  // The rate of a quaternion is half the angular velocity times the quaternion.
  const double w_rate = -0.5 * spin.dot(v), u_rate = 0.5 * (w * spin.dot(up) + spin.cross(v).dot(up));
  const double length = std::sqrt(square);
  const Vec3 axis = (u / length) * up;
  turn.pose.rotation = {w / length, axis[0], axis[1], axis[2]};
  turn.twist.angular = (2 * (u_rate * w - w_rate * u) / square) * up;
}

}  // namespace
}  // namespace pose

RootMotion::RootMotion(const Hierarchy& nodes, std::string_view node, const RootParts& parts) : parts_(parts) {
  std::string problems;
  if (const auto found = nodes.find(node)) {
    for (std::size_t i = *found; i != no_node; i = nodes[i].parent) chain_.push_back(i);
    rest_ = pose::figure_poses(nodes)[*found];
  } else {
    problems += "\n  " + pose::no_joint_named(nodes, std::string(node));
  }
  if (!parts.horizontal && !parts.vertical && parts.turn == RootParts::Turn::none)
    problems += "\n  there is nothing to take out: no movement over the ground or up and down, and no turn";
  const double largest = parts.up.cwiseAbs().maxCoeff();
  if (!(largest > 0) || !std::isfinite(parts.up.sum()))
    problems += "\n  the direction up must have a length, and be finite";
  else
    parts_.up = Vec3(parts.up / largest) / std::sqrt(Vec3(parts.up / largest).squaredNorm());
  if (!problems.empty()) throw std::invalid_argument("root motion cannot be taken out:" + problems);
}

Motion RootMotion::above(std::span<const Motion> pose) const noexcept {
  Motion motion;
  for (std::size_t i = chain_.size(); i-- > 1;) motion = compose(motion, pose[chain_[i]]);
  return motion;
}

// The identity at rest: the translation is measured from the turned rest position of the node, and only the requested
// parts are kept.
Motion RootMotion::frame_of(const Motion& node) const noexcept {
  Motion frame;
  if (parts_.turn != RootParts::Turn::none) {
    frame.pose.rotation = node.pose.rotation * rest_.rotation.conjugate();
    frame.twist.angular = node.twist.angular;
    if (parts_.turn == RootParts::Turn::yaw) pose::keep_yaw(frame, parts_.up);
  }
  const Vec3 carried_rest = frame.pose.rotation * rest_.position;
  const Vec3 way = node.pose.position - carried_rest;
  const Vec3 rate = node.twist.linear - frame.twist.angular.cross(carried_rest);
  const auto kept = [this](const Vec3& v) noexcept {
    const Vec3 upright = parts_.up.dot(v) * parts_.up;
    if (parts_.horizontal && parts_.vertical) return v;
    if (parts_.horizontal) return Vec3(v - upright);
    return parts_.vertical ? upright : Vec3(0, 0, 0);
  };
  frame.pose.position = kept(way);
  frame.twist.linear = kept(rate);
  return frame;
}

Motion RootMotion::carried(std::span<const Motion> pose) const noexcept {
  return frame_of(compose(above(pose), pose[node()]));
}

Motion RootMotion::take_out(std::span<Motion> pose) const noexcept {
  const Motion parent = above(pose), whole = compose(parent, pose[node()]), frame = frame_of(whole);
  pose[node()] = relative_to(parent, relative_to(frame, whole));
  return frame;
}

void RootMotion::put_back(std::span<Motion> pose, const Motion& frame) const noexcept {
  const Motion parent = above(pose);
  const Motion whole = compose(parent, pose[node()]);
  pose[node()] = relative_to(parent, compose(frame, whole));
}

}  // namespace tweenfall
