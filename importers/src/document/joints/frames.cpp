#include "document/joints/joint.h"

#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/rotation.h>

#include <cmath>
#include <stdexcept>

namespace tweenfall::document::joints {

namespace {

// Kinds that hold two points at a distance, rather than one point.
bool has_two_points(const JointKind& kind) {
  return std::holds_alternative<DistanceJoint>(kind) || std::holds_alternative<PulleyJoint>(kind) ||
         std::holds_alternative<SpringJoint>(kind);
}

// The places of its ends; empty where these are faulty, which is reported.
std::optional<std::array<Vec3, 2>> points_of(const JointBeingRead& read, std::span<const Pose> rests,
                                             Building& building) {
  const JointDescription& joint = read.joint;
  const Vec3 second = rests[joint.b].position;
  const bool two = has_two_points(joint.kind), gear = std::holds_alternative<GearJoint>(joint.kind);
  if (gear && read.at) {
    building.problems.add(read.at, "\"at\" means nothing for a gear: its wheels turn about hinges of their own");
    return {};
  }
  if (two && read.points.size() == 1) {
    building.problems.add(read.at, "this joint has two ends; \"at\" is a list of two points, one on each");
    return {};
  }
  if (read.points.size() == 2) return std::array{read.points[0], read.points[1]};
  if (read.points.size() == 1) return std::array{read.points[0], read.points[0]};
  if (!two) return std::array{second, second};
  if (joint.a != no_node) return std::array{rests[joint.a].position, second};
  building.problems.add(read.kind,
                        "an end in the world needs a place; say \"at\": a list of two points, the first in the world");
  return {};
}

// The axes of the second end, for most kinds those of the first.
bool axes_stand(const JointBeingRead& read, Building& building) {
  constexpr double right = 1e-6;
  const double along = read.axis.dot(read.second_axis);
  const bool universal = std::holds_alternative<UniversalJoint>(read.joint.kind);
  if (universal && std::abs(along) > right) {
    building.problems.add(read.kind, "the axes of a universal joint stand at a right angle; these at " +
                                         brief_text(degrees(std::acos(std::min(1.0, std::abs(along))))) + " degrees");
    return false;
  }
  const bool beside =
      std::holds_alternative<WheelJoint>(read.joint.kind) || std::holds_alternative<SwingTwistJoint>(read.joint.kind);
  if (beside && std::abs(along) > 1 - right) {
    building.problems.add(read.kind, "its two axes point the same way; the second stands beside the first");
    return false;
  }
  return true;
}

}  // namespace

void place(JointBeingRead& read, std::span<const Pose> rests, Building& building) {
  JointDescription& joint = read.joint;
  const auto points = points_of(read, rests, building);
  const bool wheel = std::holds_alternative<WheelJoint>(joint.kind), no_second = read.second_axis.isZero();
  if (wheel && no_second) read.second_axis = Vec3(0, 1, 0);
  if (!points || !axes_stand(read, building)) return;
  const Pose rest_a = joint.a == no_node ? Pose{} : rests[joint.a];
  const bool bevel = std::holds_alternative<GearJoint>(joint.kind) && !no_second;
  try {
    const JointFrames first = joint_frames(rest_a, rests[joint.b], (*points)[0], read.axis, read.second_axis);
    const JointFrames second = joint_frames(rest_a, rests[joint.b], (*points)[1], bevel ? read.second_axis : read.axis,
                                            bevel ? Vec3(0, 0, 0) : read.second_axis);
    joint.frame_a = first.a;
    joint.frame_b = second.b;
  } catch (const std::invalid_argument& fault) {
    building.problems.add(read.kind, fault.what());
    return;
  }
  if (!read.toward) return;
  const Quat axes = rest_a.rotation * joint.frame_a.rotation;
  std::get<SwingTwistJoint>(joint.kind).toward = normalized(axes.conjugate() * *read.toward * axes);
}

}  // namespace tweenfall::document::joints
