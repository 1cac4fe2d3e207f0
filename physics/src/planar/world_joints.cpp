#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "joints/validate.h"
#include "planar/checks.h"
#include "planar/world_data.h"

namespace tweenfall::planar {

namespace inner {
namespace {

constexpr double farthest = 1e30;

void check(const Hinge& hinge) {
  joints::validate(HingeJoint{hinge.limits, hinge.motor});
}
void check(const Slider& slider) {
  joints::validate(SliderJoint{slider.limits, slider.motor});
  demand(slider.axis.norm() > 0 && slider.axis.norm() <= farthest,
         "the axis of a slider needs a length above 0 that is finite");
  demand_number(slider.angle, "angle of a slider");
}
void check(const Weld& weld) {
  demand_number(weld.angle, "angle of a weld");
}
void check(const Distance& distance) {
  joints::validate(DistanceJoint{distance.limits});
}
void check(const Spring& spring) {
  joints::validate(SpringJoint{spring.length, spring.stiffness, spring.damping});
}
void check(const Pulley& pulley) {
  const auto in_space = [](const Vec2& point) { return Vec3(point.x(), point.y(), 0); };
  joints::validate(PulleyJoint{in_space(pulley.pulley_a), in_space(pulley.pulley_b), pulley.ratio, pulley.length});
}
void check(const Gear& gear) {
  joints::validate(GearJoint{gear.ratio});
  demand_number(gear.turned_a, "the angle that a wheel has turned");
  demand_number(gear.turned_b, "the angle that a wheel has turned");
}
void check(const Wheel& wheel) {
  joints::validate(WheelJoint{wheel.hz, wheel.zeta, wheel.suspension, wheel.motor});
  demand(wheel.axis.norm() > 0 && wheel.axis.norm() <= farthest,
         "the axis of a wheel needs a length above 0 that is finite");
}
void check_anchor(const Vec2& anchor) {
  demand(std::abs(anchor.x()) <= farthest && std::abs(anchor.y()) <= farthest,
         "anchors of a joint must be finite and at most 1e30 m");
}

struct Rope {
  double length = 0, rate = 0;  ///< m, m/s
};
Rope rope_over(const Pulley& pulley, const JointEnd& a, const JointEnd& b) {
  const auto part = [](const JointEnd& end, const Vec2& from) -> Rope {
    const Vec2 way = end.at - from;
    const double length = way.norm();
    return {length, length > 0 ? way.dot(end.velocity) / length : 0};
  };
  const Rope at_a = part(a, pulley.pulley_a), at_b = part(b, pulley.pulley_b);
  return {at_a.length + pulley.ratio * at_b.length, at_a.rate + pulley.ratio * at_b.rate};
}

}  // namespace

void validate_joint(const JointSettings& joint) {
  demand(joint.a != joint.b, "a joint needs two different ends");
  check_anchor(joint.anchor_a);
  check_anchor(joint.anchor_b);
  std::visit([](const auto& kind) { check(kind); }, joint.kind);
}

}  // namespace inner

using inner::Body;
using inner::Joint;

inner::JointEnd World::Implementation::end_of(BodyId body, const Vec2& anchor) const {
  if (body == BodyId{}) return {anchor, Vec2(0, 0), 0, 0};
  const Body& its = bodies[body.index];
  const Vec2 arm = its.turn * Vec2(anchor - makeups[body.index].mass.center);
  return {its.center + arm, its.velocity_at(arm), its.angle, its.spin};
}

JointId World::add_joint(const JointSettings& settings) {
  Implementation& world = inside();
  inner::validate_joint(settings);
  for (const BodyId& end : {settings.a, settings.b})
    if (end != BodyId{}) static_cast<void>(world.at(end));
  std::uint32_t index = 0;
  if (world.unused_joints.empty()) {
    index = static_cast<std::uint32_t>(world.joints.size());
    world.joints.emplace_back();
  } else {
    index = world.unused_joints.back();
    world.unused_joints.pop_back();
  }
  const std::uint32_t generation = world.joints[index].generation;
  world.joints[index] = {};
  world.joints[index].alive = true;
  world.joints[index].generation = generation;
  world.joints[index].settings = settings;
  if (const auto* const gear = std::get_if<Gear>(&settings.kind)) {
    world.joints[index].turned_a = gear->turned_a;
    world.joints[index].turned_b = gear->turned_b;
  }
  if (auto* const pulley = std::get_if<Pulley>(&world.joints[index].settings.kind); pulley && !pulley->length)
    pulley->length = inner::rope_over(*pulley, world.end_of(settings.a, settings.anchor_a),
                                      world.end_of(settings.b, settings.anchor_b))
                         .length;
  for (const BodyId& end : {settings.a, settings.b}) {
    if (end == BodyId{}) continue;
    world.wake_neighbors(end.index);
    world.wake(end.index);
    world.look_again(end.index);
  }
  world.keep_apart();
  return {index, generation};
}

void World::remove_joint(JointId id) {
  Implementation& world = inside();
  Joint& joint = world.at(id);
  for (const BodyId& end : {joint.settings.a, joint.settings.b}) {
    if (end == BodyId{} || !contains(end)) continue;
    world.wake_neighbors(end.index);
    world.wake(end.index);
    world.look_again(end.index);
  }
  joint = {};
  joint.generation = id.generation + 1;
  world.unused_joints.push_back(id.index);
  world.keep_apart();
}

bool World::contains(JointId id) const noexcept {
  return implementation_ && id.index < implementation_->joints.size() && implementation_->joints[id.index].alive &&
         implementation_->joints[id.index].generation == id.generation;
}

const JointSettings& World::joint(JointId id) const {
  return inside().at(id).settings;
}

JointReading World::reading(JointId id) const {
  const Implementation& world = inside();
  const Joint& joint = world.at(id);
  const inner::JointEnd a = world.end_of(joint.settings.a, joint.settings.anchor_a),
                        b = world.end_of(joint.settings.b, joint.settings.anchor_b);
  JointReading reading;
  reading.impulse = joint.total;
  reading.angular_impulse = joint.total_turn;
  const Vec2 apart = b.at - a.at, parting = b.velocity - a.velocity;
  const double length = apart.norm();
  const JointKind& kind = joint.settings.kind;
  if (const auto* const distance = std::get_if<Distance>(&kind)) {
    reading.value = length;
    reading.rate = length > 0 ? apart.dot(parting) / length : 0;
    if (!(distance->limits.hz > 0))
      reading.gap = std::max({0.0, length - distance->limits.high, distance->limits.low - length});
  } else if (std::holds_alternative<Spring>(kind)) {
    reading.value = length;
    reading.rate = length > 0 ? apart.dot(parting) / length : 0;
  } else if (const auto* const pulley = std::get_if<Pulley>(&kind)) {
    const inner::Rope rope = inner::rope_over(*pulley, a, b);
    reading.value = rope.length;
    reading.rate = rope.rate;
    reading.gap = std::max(0.0, rope.length - *pulley->length);
  } else if (std::holds_alternative<Gear>(kind)) {
    reading.value = joint.turned_b;
    reading.rate = b.spin;
    reading.turned_a = joint.turned_a;
  } else if (const auto* const slider = std::get_if<Slider>(&kind)) {
    const Vec2 along = inner::Turn::of(a.angle) * slider->axis.normalized();
    reading.value = along.dot(apart);
    reading.rate = along.dot(parting - a.spin * inner::quarter(apart));
    reading.gap = std::abs(inner::cross(along, apart));
  } else if (const auto* const wheel = std::get_if<Wheel>(&kind)) {
    const Vec2 along = inner::Turn::of(a.angle) * wheel->axis.normalized();
    reading.value = b.angle - a.angle;
    reading.rate = b.spin - a.spin;
    reading.way = along.dot(apart);
    reading.way_rate = along.dot(parting - a.spin * inner::quarter(apart));
    reading.gap = std::abs(inner::cross(along, apart));
  } else {
    if (std::holds_alternative<Hinge>(kind)) {
      reading.value = b.angle - a.angle;
      reading.rate = b.spin - a.spin;
    }
    reading.gap = length;
  }
  return reading;
}

}  // namespace tweenfall::planar
