#include <algorithm>
#include <cmath>
#include <numbers>

#include "stage/stage_data.h"

namespace tweenfall::staging {

namespace {

constexpr double more_than_rounding = 1e-3;  // of a body's size; rad

/// A described joint at its start.
struct Start {
  const JointDescription& described;
  Quat axes_a, axes_b;
  JointReading reading;
  double size = infinity;  ///< shortest edge of the smaller body's bounds, m

  [[nodiscard]] Quat between() const { return axes_a.conjugate() * axes_b; }
};

Start start_of(const StageState& state, const JointDescription& described, const StagedJoint& joint) {
  Start start{described, described.frame_a.rotation, described.frame_b.rotation, state.world.reading(joint.id)};
  for (const std::size_t node : {described.a, described.b}) {
    if (node == no_node) continue;
    const BodyId body = state.body(node)->id;
    const Pose pose = state.world.motion(body).pose;
    const Bounds room = bounds(state.world.shape(body), pose);
    start.size = std::min(start.size, (room.high - room.low).minCoeff());
    Quat& axes = node == described.a ? start.axes_a : start.axes_b;
    axes = pose.rotation * axes;
  }
  start.axes_a.normalize();
  start.axes_b.normalize();
  return start;
}

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// The angle between the frames in what the kind holds, rad.
double turn_of(const Start& start) {
  const JointKind& kind = start.described.kind;
  const auto axis = [&](const Quat& axes, int i) { return Vec3(axes * Vec3::Unit(i)); };
  if (std::holds_alternative<FixedJoint>(kind) || std::holds_alternative<SliderJoint>(kind)) {
    const Quat between = start.between();
    return 2 * std::atan2(between.vec().norm(), std::abs(between.w()));
  }
  if (std::holds_alternative<HingeJoint>(kind) || std::holds_alternative<WheelJoint>(kind))
    return angle_between(axis(start.axes_a, 0), axis(start.axes_b, 0));
  if (std::holds_alternative<UniversalJoint>(kind))
    return std::abs(angle_between(axis(start.axes_a, 0), axis(start.axes_b, 1)) - std::numbers::pi / 2);
  return 0;
}

class Limited {
 public:
  Limited(const Start& start, std::size_t joint, std::vector<PassedLimit>& found)
      : start_(start), joint_(joint), found_(found) {}

  void operator()(const BallJoint&) const {}
  void operator()(const FixedJoint&) const {}
  void operator()(const GearJoint&) const {}
  void operator()(const SpringJoint&) const {}
  void operator()(const HingeJoint& hinge) const { angle(0, hinge.limits); }
  void operator()(const SliderJoint& slider) const { length(0, slider.limits); }
  void operator()(const DistanceJoint& distance) const { length(0, distance.limits); }
  void operator()(const UniversalJoint& universal) const {
    angle(0, universal.first_limits);
    angle(1, universal.second_limits);
  }
  void operator()(const WheelJoint& wheel) const { length(1, wheel.suspension); }
  void operator()(const PulleyJoint& pulley) const {
    if (pulley.length) length(0, Limits{0, *pulley.length});
  }
  void operator()(const SwingTwistJoint& limb) const {
    angle(0, limb.twist);
    const double y = start_.reading.position[1], z = start_.reading.position[2];
    const double swing = std::hypot(y, z);
    if (!(swing > more_than_rounding)) return;
    // The cone's edge in the joint's direction: an ellipse, none if a half angle is 0.
    const auto part = [](double value, double most) { return most > 0 ? value / most : value != 0 ? infinity : 0; };
    const double share = std::hypot(part(y, limb.swing_y), part(z, limb.swing_z));
    if (share * swing > swing + more_than_rounding * share) {
      const int farther = std::abs(y) > std::abs(z) ? 1 : 2;
      const double position = farther == 1 ? y : z;
      const double edge = std::abs(position) / share;
      found_.push_back({joint_, farther, position, -edge, edge, false});
    }
  }

 private:
  void angle(int coordinate, const std::optional<Limits>& limits) const {
    check(coordinate, limits, more_than_rounding, false);
  }
  void length(int coordinate, const std::optional<Limits>& limits) const {
    check(coordinate, limits, more_than_rounding * start_.size, true);
  }
  void check(int coordinate, const std::optional<Limits>& limits, double room, bool is_length) const {
    if (!limits) return;
    const double position = start_.reading.position[static_cast<std::size_t>(coordinate)];
    if (position < limits->low - room || position > limits->high + room)
      found_.push_back({joint_, coordinate, position, limits->low, limits->high, is_length});
  }

  const Start& start_;
  std::size_t joint_;
  std::vector<PassedLimit>& found_;
};

}  // namespace

void find_joint_starts(const StageState& state, const StageDescription& description, StageInspection& out) {
  for (std::size_t i = 0; i < description.joints.size(); ++i) {
    const JointDescription& described = description.joints[i];
    const Start start = start_of(state, described, state.joints->list[i]);
    std::visit(Limited(start, i, out.passed_limits), described.kind);
    // The excess length of a rope or a pulley is reported as its limit.
    const bool has_length =
        std::holds_alternative<DistanceJoint>(described.kind) || std::holds_alternative<PulleyJoint>(described.kind);
    const auto beyond = [](double value, double rounding) { return value > rounding ? value : 0; };
    const double gap = has_length ? 0 : beyond(start.reading.gap, more_than_rounding * start.size);
    const double turn = beyond(turn_of(start), more_than_rounding);
    if (gap > 0 || turn > 0) out.open_joints.push_back({i, gap, turn});
  }
}

}  // namespace tweenfall::staging
