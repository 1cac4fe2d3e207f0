#include <cmath>

#include "flat/flat.h"
#include "saving/bytes.h"
#include "state/checks.h"
#include "state/countable.h"
#include "state/world_data.h"

namespace tweenfall::flat {

void Flat::write(saving::ByteWriter& bytes) const {
  bytes.list(world_.save());
  bytes.number(static_cast<std::uint64_t>(entries_.size()));
  for (const Entry& entry : entries_) {
    saving::walk(bytes, entry.id);
    bytes.number(entry.generation);
    saving::walk(bytes, entry.drive);
    bytes.number(entry.groups);
    bytes.number(entry.collides_with);
    saving::walk(bytes, entry.told);
    for (const double number : {entry.force.x(), entry.force.y(), entry.torque}) bytes.number(number);
  }
  bytes.number(static_cast<std::uint64_t>(ignored_.size()));
  for (const Pair& pair : ignored_) {
    bytes.number(pair.first);
    bytes.number(pair.second);
  }
  bytes.number(static_cast<std::uint64_t>(links_.size()));
  for (const Link& link : links_) {
    saving::walk(bytes, link.id);
    bytes.number(link.generation);
  }
}

void Flat::read(saving::ByteReader& bytes) {
  std::vector<std::byte> saved;
  bytes.list(saved);
  world_.load(saved);
  std::uint64_t count = 0;
  bytes.number(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    Entry& entry = entries_.emplace_back();
    saving::walk(bytes, entry.id);
    bytes.number(entry.generation);
    saving::walk(bytes, entry.drive);
    bytes.number(entry.groups);
    bytes.number(entry.collides_with);
    saving::walk(bytes, entry.told);
    for (double* const number : {&entry.force.x(), &entry.force.y(), &entry.torque}) bytes.number(*number);
    bytes.require(entry.force.cwiseAbs().maxCoeff() <= 1e30 && std::abs(entry.torque) <= 1e30, "a force is not finite");
    if (entry.id == BodyId{}) continue;
    bytes.require(world_.contains(entry.id), "the plane has no such body");
    owners_.resize(std::max<std::size_t>(owners_.size(), entry.id.index + std::size_t{1}), 0xffffffff);
    bytes.require(owners_[entry.id.index] == 0xffffffff, "two bodies share one in the plane");
    owners_[entry.id.index] = static_cast<std::uint32_t>(i);
  }
  bytes.number(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    Pair& pair = ignored_.emplace_back();
    bytes.number(pair.first);
    bytes.number(pair.second);
    bytes.require(i == 0 || ignored_[i - 1] < pair, "ignored pairs of the plane are not in order");
  }
  std::vector<char> taken;
  bytes.number(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    Link& link = links_.emplace_back();
    saving::walk(bytes, link.id);
    bytes.number(link.generation);
    bytes.require(link.id == JointId{} || world_.contains(link.id), "the plane has no such joint");
    if (link.id == JointId{}) continue;
    taken.resize(std::max<std::size_t>(taken.size(), link.id.index + std::size_t{1}), 0);
    bytes.require(taken[link.id.index] == 0, "two joints share one in the plane");
    taken[link.id.index] = 1;
  }
}

void Flat::check(const state::WorldState& world) {
  plane_ = world.settings.plane;
  state::require(links_.size() <= world.joints.size(), "a saved world and its plane do not have the same joints");
  for (const state::Joint& joint : world.joints)
    if (joint.alive) require_joint(plane_, joint.settings);
  for (const soft::SoftBody& soft : world.softs) {
    if (!soft.alive) continue;
    require_soft(plane_, *soft.made);
    for (const Vec3& place : soft.positions) require_point(plane_, place, "a node of a soft body");
    for (const Vec3& velocity : soft.velocities) require_point(plane_, velocity, "the velocity of a node");
    for (const soft::PinState& pin : soft.pins) {
      require_point(plane_, pin.target, "the point of a pin");
      require_point(plane_, pin.pin.point, "the point of a pin");
    }
  }
  std::size_t known = 0;
  for (const Entry& entry : entries_) known += entry.id == BodyId{} ? 0 : 1;
  state::require(known == world_.bodies().size() && entries_.size() <= world.bodies.size(),
                 "a saved world and its plane do not have the same bodies");
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const state::Body& body = world.bodies[i];
    if (!body.alive) continue;
    BodySettings its;
    its.shape = body.shape();
    its.motion = body.motion;
    require_body(plane_, its);
    require_motion(plane_, body.extra.value().target);
  }
}

}  // namespace tweenfall::flat
