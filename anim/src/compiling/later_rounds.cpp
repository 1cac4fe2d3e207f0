#include "compiling/later_rounds.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::crowd {

namespace {

/// How far at most a rotation that was turned and rounded takes a point at a distance of 1: a quaternion that is off by
/// d, in length too, gives axes that are off by 6 d. What the turn itself loses in many rounds is far less.
constexpr double turn_rounding = 6 * place_rounding;
/// Quaternions in float are of unit length but for roundings, of which this is more than what they may stretch.
constexpr double unit_stretch = 1 + 1e-6;

Mat3 axes_of(const Pose& pose) {
  return pose.rotation.toRotationMatrix() * pose.scale.asDiagonal();
}

Vec3 gain_of(const Climb& climb) {
  return {climb.gain[0], climb.gain[1], climb.gain[2]};
}

bool turns_on(const Climb& climb) {
  return climb.turn[0] != 0 || climb.turn[1] != 0 || climb.turn[2] != 0;
}

}  // namespace

LaterRounds::LaterRounds(const Hierarchy& nodes, std::span<const Climb> climbs, double arm)
    : nodes_(nodes), arm_(arm), climbs_(nodes.size()), joints_(nodes.size()) {
  for (const Climb& climb : climbs) climbs_[climb.joint] = climb;
}

RoundErrors LaterRounds::errors(std::span<const Motion> wanted, std::span<const Motion> found) {
  const Place outside{Mat3::Identity(), Vec3(0, 0, 0), Vec3(0, 0, 0)};
  segments_.assign(1, {});
  RoundErrors largest;
  for (std::size_t node = 0; node < nodes_.size(); ++node) {
    const Pose &here = wanted[node].pose, &there = found[node].pose;
    const Vec3 gain = gain_of(climbs_[node]);
    const std::size_t parent = nodes_[node].parent;
    Joint joint{.wanted = outside, .found = outside};
    if (parent != no_node) joint = joints_[parent];
    joint.wanted = joint.wanted.moved(here.position, gain);
    joint.found = joint.found.moved(there.position, gain);
    const Growing length{joint.stretch * there.position.norm(), joint.stretch * gain.norm()};
    joint.rounding.first += place_rounding * length.first;
    joint.rounding.growth += place_rounding * length.growth;
    joint.first.lengthen(length.first);
    joint.growth.lengthen(length.growth);
    if (turns_on(climbs_[node])) {
      const Segment above = segments_[joint.segment];
      const double rounding = axes_rounding * std::sqrt(joint.first.count) + above.turn_error;
      const double apart = (joint.wanted.axes - joint.found.axes).norm() + rounding * joint.stretch;
      segments_.push_back({.error = error_at(joint, joint.wanted.origin, joint.found.origin),
                           .axes_error = above.axes_error * joint.stretch + above.stretch * apart,
                           .stretch = above.stretch * joint.stretch,
                           .turn_error = turn_rounding});
      joint = {.wanted = outside, .found = outside, .segment = segments_.size() - 1};
    }
    joint.wanted.axes *= axes_of(here);
    joint.found.axes *= axes_of(there);
    const double scale = std::max(here.scale.cwiseAbs().maxCoeff(), there.scale.cwiseAbs().maxCoeff());
    joint.stretch *= unit_stretch * scale;
    joint.first.count += 1;
    joint.growth.count += 1;
    joints_[node] = joint;
    joint.first.lengthen(arm_ * joint.stretch);
    for (int axis = 0; axis < 3; ++axis)
      for (const double arm : {-arm_, arm_}) {
        const Growing error = error_at(joint, joint.wanted.origin + arm * joint.wanted.axes.col(axis),
                                       joint.found.origin + arm * joint.found.axes.col(axis));
        largest.include({.later = error.first, .growth = error.growth});
      }
  }
  return largest;
}

/// Of a point of a joint. @param wanted, found  where it is within the segment
LaterRounds::Growing LaterRounds::error_at(const Joint& joint, const Vec3& wanted, const Vec3& found) const {
  const Segment& in = segments_[joint.segment];
  // What floats round of many rotations hardly ever adds up.
  const auto moved = [&](double far, double apart, double rounding, const Levers& levers, double turned) {
    const double turns = axes_rounding * std::sqrt(levers.squares);
    return in.axes_error * far + in.stretch * (apart + rounding + turns + in.turn_error * turned);
  };
  const Vec3 &gain = joint.wanted.gain, &gain_found = joint.found.gain;
  return {
      in.error.first + moved(wanted.norm(), (wanted - found).norm(), joint.rounding.first, joint.first, found.norm()),
      in.error.growth +
          moved(gain.norm(), (gain - gain_found).norm(), joint.rounding.growth, joint.growth, gain_found.norm())};
}

}  // namespace tweenfall::crowd
