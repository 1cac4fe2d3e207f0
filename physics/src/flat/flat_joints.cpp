#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "flat/axes.h"
#include "flat/flat.h"
#include "flat/sections.h"
#include "joints/kinds/kinds.h"
#include "state/world_data.h"

namespace tweenfall {

namespace flat {
namespace {

[[noreturn]] void refuse_joint(const std::string& why) {
  throw std::invalid_argument("in a plane " + why);
}

/// Refuses joints that do not lie in the plane, or kinds that do not exist there.
struct InPlane {
  const Axes& axes;
  const tweenfall::JointSettings& settings;

  void operator()(const BallJoint&) const {}
  void operator()(const FixedJoint&) const { require_upright("a weld"); }
  void operator()(const SliderJoint&) const {
    require_upright("a slider");
    if (!lies_in(axes, settings.frame_a.rotation * Vec3(1, 0, 0))) refuse_joint("the axis of a slider must lie in it");
  }
  void operator()(const HingeJoint&) const { require_axes_upright("the axis of a hinge"); }
  void operator()(const WheelJoint&) const { require_axes_upright("the axis of a wheel"); }
  void operator()(const GearJoint&) const { require_axes_upright("the axes of a gear"); }
  void operator()(const PulleyJoint& pulley) const {
    if (!lies_in(axes, pulley.pulley_a) || !lies_in(axes, pulley.pulley_b)) refuse_joint("both pulleys must lie in it");
  }
  void operator()(const DistanceJoint&) const {}
  void operator()(const SpringJoint&) const {}
  template <class Kind>
  void operator()(const Kind&) const {
    refuse_joint("joints can only be balls, hinges, sliders, welds, distances, springs, pulleys, gears and wheels");
  }

  void require_axes_upright(const std::string& what) const {
    for (const Pose* const frame : {&settings.frame_a, &settings.frame_b})
      if (!turns_in(axes, frame->rotation * Vec3(1, 0, 0))) refuse_joint(what + " must be perpendicular to it");
  }
  void require_upright(const std::string& what) const {
    const Quat between = settings.frame_a.rotation * settings.frame_b.rotation.conjugate();
    if (!turns_in(axes, between.vec())) refuse_joint(what + " must not tilt its bodies");
  }
};

/// Whether a turn in the plane is one about the wheel's own axis, or the opposite one.
struct GearSigns {
  double a = 1, b = 1;
};
GearSigns signs_of(const Axes& axes, const joints::Placement& at) {
  return {axes.sign * std::copysign(1.0, at.x_a()[axes.normal]), axes.sign * std::copysign(1.0, at.x_b()[axes.normal])};
}

/// An angle about an axis perpendicular to the plane, as the plane counts it.
class AngleInPlane {
 public:
  /// @param turned  angle of b relative to a in the plane, when the joint's angle is `here`, rad
  AngleInPlane(const Axes& axes, const joints::Placement& at, double turned, double here)
      : sign_(axes.sign * std::copysign(1.0, at.x_a()[axes.normal])), turned_(turned), here_(here) {}

  [[nodiscard]] double of(double value) const { return turned_ + sign_ * (value - here_); }
  [[nodiscard]] std::optional<Limits> of(std::optional<Limits> limits) const {
    if (!limits) return limits;
    const double low = of(limits->low), high = of(limits->high);
    limits->low = std::min(low, high);
    limits->high = std::max(low, high);
    return limits;
  }
  [[nodiscard]] std::optional<Motor> of(std::optional<Motor> motor) const {
    if (!motor) return motor;
    motor->speed *= sign_;
    if (motor->position) motor->position = of(*motor->position);
    return motor;
  }

 private:
  double sign_, turned_, here_;
};

}  // namespace

void require_joint(WorldPlane plane, const tweenfall::JointSettings& settings) {
  if (plane == WorldPlane::none) return;
  const Axes axes = Axes::of(plane);
  for (const Pose* const frame : {&settings.frame_a, &settings.frame_b})
    if (!lies_in(axes, frame->position)) refuse_joint("the points of a joint must lie in it");
  std::visit(InPlane{axes, settings}, settings.kind);
}

/// A joint as it is in the plane, for the present poses of its bodies.
planar::JointSettings Flat::joint_in_plane(const state::WorldState& world, const state::Joint& joint) const {
  const Axes axes = Axes::of(plane_);
  const tweenfall::JointSettings& its = joint.settings;
  planar::JointSettings out;
  double turned = 0;  // of b relative to a, rad
  if (its.a != BodyId{}) {
    out.a = entries_[its.a.index].id;
    turned -= world_.motion(out.a).angle;
  }
  out.b = entries_[its.b.index].id;
  turned += world_.motion(out.b).angle;
  out.anchor_a = axes.flat(its.frame_a.position);
  out.anchor_b = axes.flat(its.frame_b.position);
  out.collide = its.collide;
  const joints::Placement at = joints::placement_in(joint, world.bodies);
  // The angle after b has turned until the frames match.
  const auto matched = [&] { return turned + axes.angle(at.axes_a * at.axes_b.conjugate()); };
  if (const auto* const distance = std::get_if<DistanceJoint>(&its.kind)) {
    out.kind = planar::Distance{distance->limits};
  } else if (const auto* const spring = std::get_if<SpringJoint>(&its.kind)) {
    out.kind = planar::Spring{spring->length, spring->stiffness, spring->damping};
  } else if (const auto* const pulley = std::get_if<PulleyJoint>(&its.kind)) {
    out.kind = planar::Pulley{axes.flat(pulley->pulley_a), axes.flat(pulley->pulley_b), pulley->ratio, pulley->length};
  } else if (const auto* const gear = std::get_if<GearJoint>(&its.kind)) {
    const GearSigns signs = signs_of(axes, at);
    out.kind = planar::Gear{gear->ratio * signs.a * signs.b, signs.a * joint.angles[0], signs.b * joint.angles[1]};
  } else if (const auto* const slider = std::get_if<SliderJoint>(&its.kind)) {
    out.kind =
        planar::Slider{axes.flat(its.frame_a.rotation * Vec3(1, 0, 0)), matched(), slider->limits, slider->motor};
  } else if (std::holds_alternative<FixedJoint>(its.kind)) {
    out.kind = planar::Weld{matched()};
  } else if (const auto* const hinge = std::get_if<HingeJoint>(&its.kind)) {
    const AngleInPlane angle(axes, at, turned, joints::coordinates_of(*hinge, joint, at).position[0]);
    out.kind = planar::Hinge{angle.of(hinge->limits), angle.of(hinge->motor)};
  } else if (const auto* const wheel = std::get_if<WheelJoint>(&its.kind)) {
    const AngleInPlane angle(axes, at, turned, joints::coordinates_of(*wheel, joint, at).position[0]);
    out.kind = planar::Wheel{axes.flat(its.frame_a.rotation * Vec3(0, 1, 0)), wheel->hz, wheel->zeta, wheel->suspension,
                             angle.of(wheel->motor)};
  }
  return out;
}

void Flat::take_over_joints(const state::WorldState& world) {
  links_.resize(std::max(links_.size(), world.joints.size()));
  for (std::uint32_t i = 0; i < world.joints.size(); ++i) {
    const state::Joint& joint = world.joints[i];
    Link& link = links_[i];
    if (link.id != JointId{} && (!joint.alive || link.generation != joint.generation)) forget_joint(i);
    if (joint.alive && link.id == JointId{}) link = {world_.add_joint(joint_in_plane(world, joint)), joint.generation};
  }
}

void Flat::forget_joint(std::uint32_t index) {
  if (index >= links_.size()) return;
  if (world_.contains(links_[index].id)) world_.remove_joint(links_[index].id);
  links_[index] = {};
}

void Flat::hand_back_joints(state::WorldState& world, double dt) const {
  const Axes axes = Axes::of(plane_);
  for (std::uint32_t i = 0; i < world.joints.size() && i < links_.size(); ++i) {
    state::Joint& joint = world.joints[i];
    if (!joint.alive || !world_.contains(links_[i].id)) continue;
    const planar::JointReading reading = world_.reading(links_[i].id);
    joint.force = axes.space(reading.impulse) / dt;
    joint.torque = axes.space(reading.angular_impulse) / dt;
    const joints::Placement at = joints::placement_in(joint, world.bodies);
    if (const auto* const hinge = std::get_if<HingeJoint>(&joint.settings.kind)) {
      joint.angles[0] = joints::coordinates_of(*hinge, joint, at).position[0];
    } else if (const auto* const wheel = std::get_if<WheelJoint>(&joint.settings.kind)) {
      joint.angles[0] = joints::coordinates_of(*wheel, joint, at).position[0];
    } else if (std::holds_alternative<GearJoint>(joint.settings.kind)) {
      const GearSigns signs = signs_of(axes, at);
      joint.angles[0] = signs.a * reading.turned_a;
      joint.angles[1] = signs.b * reading.value;
    }
  }
}

}  // namespace flat

void World::Implementation::break_in_plane() {
  broken.clear();
  for (std::uint32_t i = 0; i < joints.size(); ++i) {
    const state::Joint& joint = joints[i];
    if (!joint.alive) continue;
    if (joint.force.norm() > joint.settings.break_force || joint.torque.norm() > joint.settings.break_torque)
      broken.push_back({i, joint.generation});
  }
  for (const JointId& id : broken) remove_joint(id.index);
}

}  // namespace tweenfall
