#include <algorithm>
#include <stdexcept>
#include <string>

#include "joints/kinds/kinds.h"
#include "joints/validate.h"
#include "state/world_data.h"

namespace tweenfall {

namespace joints {
namespace {

/// How far the frames are apart in what the kind holds together, or beyond what it allows, m.
double gap_of(const state::Joint& joint, const Placement& at) {
  const JointKind& kind = joint.settings.kind;
  const Vec3 gap = at.gap();
  const Vec3 own = at.axes_a.conjugate() * gap;
  const auto beyond = [&](double low, double high) {
    const double where = coordinates_of(joint, at).position[0];
    return std::max({0.0, low - where, where - high});
  };
  if (std::holds_alternative<SliderJoint>(kind)) return Vec3(0, own.y(), own.z()).norm();
  if (std::holds_alternative<WheelJoint>(kind)) return Vec3(own.x(), 0, own.z()).norm();
  if (const auto* distance = std::get_if<DistanceJoint>(&kind))
    return distance->limits.hz > 0 ? 0 : beyond(distance->limits.low, distance->limits.high);
  if (const auto* pulley = std::get_if<PulleyJoint>(&kind)) return beyond(0, *pulley->length);
  if (std::holds_alternative<GearJoint>(kind) || std::holds_alternative<SpringJoint>(kind)) return 0;
  return gap.norm();
}

}  // namespace
}  // namespace joints

state::Joint& World::Implementation::at(JointId id) {
  if (!(id.index < joints.size() && joints[id.index].alive && joints[id.index].generation == id.generation))
    throw std::invalid_argument("there is no joint with index " + std::to_string(id.index) + " and generation " +
                                std::to_string(id.generation) +
                                ": it was removed, it broke, or it belongs to another world");
  return joints[id.index];
}
const state::Joint& World::Implementation::at(JointId id) const {
  return const_cast<Implementation*>(this)->at(id);
}

void World::Implementation::wake_ends(const state::Joint& joint) {
  for (const BodyId& end : {joint.settings.a, joint.settings.b}) {
    if (end == BodyId{} || !bodies[end.index].alive) continue;
    if (!bodies[end.index].immovable()) wake(end.index);
  }
}

void World::Implementation::wake_jointed(std::uint32_t index) {
  for (const state::Joint& joint : joints)
    if (joint.alive && (joint.settings.a.index == index || joint.settings.b.index == index)) wake_ends(joint);
}

void World::Implementation::remove_joint(std::uint32_t index) {
  state::Joint& joint = joints[index];
  wake_ends(joint);
  const JointSettings& its = joint.settings;
  if (!its.collide && its.a != BodyId{} && ignored.let_go(its.a.index, its.b.index))
    meet_or_not(its.a.index, its.b.index);
  joint.alive = false;
  ++joint.generation;
  unused_joints.push_back(index);
}

void World::Implementation::remove_joints_of(std::uint32_t body) {
  for (std::uint32_t i = 0; i < joints.size(); ++i)
    if (joints[i].alive && (joints[i].settings.a.index == body || joints[i].settings.b.index == body)) remove_joint(i);
}

void World::Implementation::gather_links() {
  links.clear();
  for (state::Joint& joint : joints) {
    if (!joint.alive) continue;
    const std::uint32_t a = joint.settings.a.index;
    const std::uint32_t b = joint.settings.b.index;
    const bool to_world = joint.settings.a == BodyId{};
    if (bodies[b].immovable() && (to_world || bodies[a].immovable())) {
      // It does nothing, and must not remember an impulse once its ends are let go.
      joint.force.setZero();
      joint.torque.setZero();
      joint.kept.fill(0);
      continue;
    }
    links.push_back({to_world ? joints::JointLink::world : a, b, &joint});
  }
}

void World::Implementation::leave_sleeping_links() {
  std::erase_if(links, [&](const joints::JointLink& link) {
    const auto moves = [&](std::uint32_t end) {
      return end != joints::JointLink::world && !bodies[end].immovable() && !bodies[end].asleep;
    };
    return !moves(link.a) && !moves(link.b);
  });
}

void World::Implementation::end_links(double dt) {
  broken.clear();
  for (const joints::JointLink& link : links) {
    const state::Joint& joint = *link.joint;
    if (link.a != joints::JointLink::world && bodies[link.a].immovable())
      bodies[link.a].extra.own().reaction -= joint.force * dt;
    if (bodies[link.b].immovable()) bodies[link.b].extra.own().reaction += joint.force * dt;
    if (!(joint.force.norm() > joint.settings.break_force) && !(joint.torque.norm() > joint.settings.break_torque))
      continue;
    const auto index = static_cast<std::uint32_t>(link.joint - joints.data());
    broken.push_back({index, joint.generation});
  }
  for (const JointId& id : broken) remove_joint(id.index);
}

JointId World::add_joint(const JointSettings& settings) {
  Implementation& world = changing();
  state::Joint joint;
  joint.settings = joints::checked(settings);
  flat::require_joint(world.settings.plane, joint.settings);
  world.at(settings.b);
  if (settings.a != BodyId{}) {
    world.at(settings.a);
    if (settings.a == settings.b) throw std::invalid_argument("a joint needs two bodies, but both are the same");
  }
  for (const BodyId& end : {settings.a, settings.b})
    if (end != BodyId{} && is_scenery(world.at(end).shape().solid))
      throw std::invalid_argument(std::string("a body with ") + kind_name(world.at(end).shape().solid) +
                                  " takes no joint: join to the world instead");
  if (auto* pulley = std::get_if<PulleyJoint>(&joint.settings.kind); pulley && !pulley->length) {
    pulley->length = 0;
    pulley->length = joints::coordinates_of(joint, joints::placement_in(joint, world.bodies)).position[0];
  }
  joint.alive = true;
  std::uint32_t index = 0;
  if (world.unused_joints.empty()) {
    index = static_cast<std::uint32_t>(world.joints.size());
    world.joints.push_back(joint);
  } else {
    index = world.unused_joints.back();
    world.unused_joints.pop_back();
    joint.generation = world.joints[index].generation;
    world.joints[index] = joint;
  }
  if (!settings.collide && settings.a != BodyId{} && world.ignored.hold(settings.a.index, settings.b.index))
    world.meet_or_not(settings.a.index, settings.b.index);
  world.wake_ends(joint);
  return {index, joint.generation};
}

void World::remove_joint(JointId id) {
  Implementation& world = changing();
  world.at(id);
  world.remove_joint(id.index);
}

bool World::contains(JointId id) const noexcept {
  if (!implementation_) return false;
  const auto& joints = implementation_->joints;
  return id.index < joints.size() && joints[id.index].alive && joints[id.index].generation == id.generation;
}

std::vector<JointId> World::joints() const {
  std::vector<JointId> result;
  const auto& all = inside().joints;
  for (std::uint32_t i = 0; i < all.size(); ++i)
    if (all[i].alive) result.push_back({i, all[i].generation});
  return result;
}

const JointSettings& World::joint(JointId id) const {
  return inside().at(id).settings;
}

void World::set_joint(JointId id, const JointKind& kind) {
  Implementation& world = changing();
  state::Joint& joint = world.at(id);
  if (kind.index() != joint.settings.kind.index())
    throw std::invalid_argument("a joint keeps its kind: remove it and add another");
  JointSettings settings = joint.settings;
  settings.kind = kind;
  settings = joints::checked(settings);
  flat::require_joint(world.settings.plane, settings);
  if (auto* pulley = std::get_if<PulleyJoint>(&settings.kind); pulley && !pulley->length)
    pulley->length = std::get<PulleyJoint>(joint.settings.kind).length;
  joint.settings = settings;
  if (world.flat.has_value()) world.flat.own().forget_joint(id.index);
  world.wake_ends(joint);
}

JointReading World::reading(JointId id) const {
  const Implementation& world = inside();
  const state::Joint& joint = world.at(id);
  const joints::Placement at = joints::placement_in(joint, world.bodies);
  const joints::Coordinates coordinates = joints::coordinates_of(joint, at);
  const Twist twist_a = joint.settings.a == BodyId{} ? Twist{} : world.bodies[joint.settings.a.index].twist;
  const Twist& twist_b = world.bodies[joint.settings.b.index].twist;
  JointReading reading;
  reading.force = joint.force;
  reading.torque = joint.torque;
  reading.coordinates = coordinates.count;
  reading.position = coordinates.position;
  for (std::size_t i = 0; i < static_cast<std::size_t>(coordinates.count); ++i) {
    const joints::Direction& way = coordinates.direction[i];
    reading.rate[i] = way.linear_b.dot(twist_b.linear) + way.turn_b.dot(twist_b.angular) -
                      way.linear_a.dot(twist_a.linear) - way.turn_a.dot(twist_a.angular);
  }
  reading.gap = joints::gap_of(joint, at);
  return reading;
}

std::span<const JointId> World::broken_joints() const noexcept {
  return implementation_ ? std::span<const JointId>(implementation_->broken) : std::span<const JointId>();
}

}  // namespace tweenfall
