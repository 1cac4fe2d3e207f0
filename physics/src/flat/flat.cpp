#include "flat/flat.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <tuple>

#include "flat/sections.h"
#include "saving/bytes.h"
#include "state/world_data.h"
#include "step/keyed_step.h"

namespace tweenfall::flat {

namespace {

bool same(const Motion& a, const Motion& b) {
  return a.pose.position == b.pose.position && a.pose.rotation.coeffs() == b.pose.rotation.coeffs() &&
         a.twist.linear == b.twist.linear && a.twist.angular == b.twist.angular;
}

const char* name_of(WorldPlane plane) {
  return plane == WorldPlane::xy ? "xy" : plane == WorldPlane::xz ? "xz" : "yz";
}

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument(what);
}

planar::BodySettings settings_of(const state::Body& body, const Axes& axes) {
  const state::Makeup& makeup = *body.makeup;
  planar::BodySettings its;
  its.shape = section_of(makeup.shape, axes);
  // A body has the mass and the moment of inertia that it has in space.
  if (makeup.mass.mass > 0) {
    its.mass = makeup.mass.mass;
    its.moment = makeup.mass.inertia(axes.normal, axes.normal);
    its.center = axes.flat(makeup.mass.center);
  }
  its.friction = makeup.friction;
  its.restitution = makeup.restitution;
  its.rolling_friction = makeup.rolling_friction;
  its.friction_combine = makeup.friction_combine;
  its.restitution_combine = makeup.restitution_combine;
  its.sensor = makeup.sensor;
  its.linear_damping = makeup.linear_damping;
  its.angular_damping = makeup.angular_damping;
  its.fixed = body.fixed;
  its.groups = body.groups();
  its.collides_with = body.collides_with();
  its.drive = body.drive;
  its.motion = axes.flat(body.motion);
  return its;
}

}  // namespace

void validate(const WorldSettings& settings) {
  require(settings.plane <= WorldPlane::yz, "there is no such plane");
  if (settings.plane == WorldPlane::none) return;
  const std::string name = name_of(settings.plane);
  require(settings.gravity[Axes::of(settings.plane).normal] == 0,
          "gravity must lie in the world's plane, " + name + ": perpendicular to it, it must be 0");
  require(settings.integrator == Integrator::exact_quadratic && settings.solver == ContactSolver{} &&
              settings.separation == Parting{} && settings.collision == Detection{} &&
              settings.broad_phase == PairSearch{},
          "a world in a plane has an integrator, a solver, a separation, a collision and a broad phase of its own; no "
          "other can be chosen");
}

void require_body(WorldPlane plane, const BodySettings& body) {
  if (plane == WorldPlane::none) return;
  const Axes axes = Axes::of(plane);
  planar::validate(section_of(body.shape, axes));
  require(body.surface_velocity.linear == Vec3::Zero() && body.surface_velocity.angular == Vec3::Zero(),
          "in a plane there are no moving surfaces");
  require(body.spinning_friction == 0,
          "in a plane nothing spins about the normal of a contact: there is no spinning friction");
  require(!body.collision, "in a plane there is one collision detection: a body takes none of its own");
  require_motion(plane, body.motion);
}

void require_motion(WorldPlane plane, const Motion& motion) {
  if (plane == WorldPlane::none) return;
  const Axes axes = Axes::of(plane);
  const std::string name = std::string("the world's plane, ") + name_of(plane);
  require(lies_in(axes, motion.pose.position), "the body does not lie in " + name);
  require(turns_in(axes, motion.pose.rotation.vec()), "the body is tilted out of " + name);
  require(lies_in(axes, motion.twist.linear), "the body moves out of " + name);
  require(turns_in(axes, motion.twist.angular), "the body turns out of " + name);
}

void require_point(WorldPlane plane, const Vec3& point, const char* what) {
  if (plane == WorldPlane::none) return;
  require(lies_in(Axes::of(plane), point), std::string(what) + " does not lie in the world's plane, " + name_of(plane));
}

void require_soft(WorldPlane plane, const SoftSettings& soft) {
  if (plane == WorldPlane::none) return;
  require(soft.triangles.empty() && soft.tetrahedra.empty() && soft.enclosures.empty(),
          "in a plane a soft body has nodes, edges and bends, and neither faces nor volumes: of a cloth that is seen "
          "from its side a rope is left");
  for (std::size_t i = 0; i < soft.positions.size(); ++i)
    require_point(plane, soft.positions[i], ("node " + std::to_string(i)).c_str());
  for (std::size_t i = 0; i < soft.velocities.size(); ++i)
    require_point(plane, soft.velocities[i], ("the velocity of node " + std::to_string(i)).c_str());
}

Vec3 in_plane(WorldPlane plane, const Vec3& v) {
  if (plane == WorldPlane::none) return v;
  const Axes axes = Axes::of(plane);
  return axes.space(axes.flat(v));
}

void refuse(WorldPlane plane, const char* what) {
  require(plane == WorldPlane::none, std::string("in a plane there are no ") + what);
}

void Flat::begin(const WorldSettings& settings) {
  plane_ = settings.plane;
  world_ = planar::World({.gravity = Axes::of(plane_).flat(settings.gravity),
                          .sleep_speed = settings.sleep_speed,
                          .sleep_after = settings.sleep_after,
                          .push_out_speed = settings.push_out_speed});
}

void Flat::take_over(const state::Body& body, std::uint32_t index, const Vec3& gravity) {
  const Axes axes = Axes::of(plane_);
  Entry& entry = entries_[index];
  if (entry.id != BodyId{} && (!body.alive || entry.generation != body.generation)) {
    world_.remove(entry.id);
    entry = {};
  }
  if (!body.alive) return;
  if (entry.id == BodyId{}) {
    entry = {world_.add(settings_of(body, axes)),
             body.generation,
             body.drive,
             body.groups(),
             body.collides_with(),
             body.motion};
    owners_.resize(std::max<std::size_t>(owners_.size(), entry.id.index + std::size_t{1}));
    owners_[entry.id.index] = index;
  }
  // A path may keep turning: its angle continues from that of the body.
  const auto beside = [&](planar::Motion motion) {
    const double whole = 2 * std::numbers::pi, now = world_.motion(entry.id).angle;
    motion.angle += whole * std::floor((now - motion.angle) / whole + 0.5);
    return motion;
  };
  if (!(entry.drive == body.drive)) {
    world_.set_drive(entry.id, body.drive);
    entry.drive = body.drive;
  }
  if (!same(entry.told, body.motion)) {
    world_.set_motion(entry.id, beside(axes.flat(body.motion)));
    // If a soft body moved it, it continues toward where it was driven.
    if (body.drive.owner() == Owner::driven) world_.set_target(entry.id, beside(axes.flat(body.target())));
    entry.told = body.motion;
  }
  if (entry.groups != body.groups() || entry.collides_with != body.collides_with()) {
    world_.set_groups(entry.id, body.groups(), body.collides_with());
    entry.groups = body.groups();
    entry.collides_with = body.collides_with();
  }
  if (body.has_target && !body.fixed) world_.set_target(entry.id, beside(axes.flat(body.target())));
  const Vec3 force = body.steady_force(gravity);
  if (force != Vec3::Zero()) world_.apply_force(entry.id, axes.flat(force), axes.flat(body.center));
  const double torque = axes.sign * body.torque()[axes.normal];
  if (torque != 0) world_.apply_torque(entry.id, torque);
  const bool stirred = body.still_for < world_.still_for(entry.id);
  if (!body.immovable() && !body.asleep && (stirred || world_.asleep(entry.id))) world_.wake(entry.id);
}

void Flat::take_over_ignored(const state::WorldState& world) {
  std::vector<Pair> now;
  for (const state::IgnoredPairs::Entry& entry : world.ignored.all()) now.emplace_back(entry.a, entry.b);
  if (now == ignored_) return;
  const auto here = [&](const Pair& pair) {
    return pair.first < entries_.size() && pair.second < entries_.size() && entries_[pair.first].id != BodyId{} &&
           entries_[pair.second].id != BodyId{};
  };
  for (const Pair& pair : ignored_)
    if (here(pair) && !std::binary_search(now.begin(), now.end(), pair))
      world_.collide(entries_[pair.first].id, entries_[pair.second].id);
  for (const Pair& pair : now)
    if (here(pair)) world_.ignore(entries_[pair.first].id, entries_[pair.second].id);
  ignored_ = std::move(now);
}

void Flat::take_over(const state::WorldState& world) {
  entries_.resize(std::max(entries_.size(), world.bodies.size()));
  for (std::uint32_t i = 0; i < world.bodies.size(); ++i) take_over(world.bodies[i], i, world.settings.gravity);
  take_over_ignored(world);
  take_over_joints(world);
}

void Flat::step(double dt, double parts) {
  try {
    world_.step(dt, dt * parts);
  } catch (const NotFinite& fault) {
    const std::uint32_t index = index_of(fault.body);
    throw NotFinite({index, entries_[index].generation}, fault.time, fault.cause);
  }
}

void Flat::tell_contacts(state::WorldState& world) const {
  const Axes axes = Axes::of(plane_);
  std::vector<Contact> before;
  before.swap(world.planar_contacts);
  const auto handle = [&](const BodyId& id) {
    const std::uint32_t index = index_of(id);
    return BodyId{index, entries_[index].generation};
  };
  for (const planar::Contact& from : world_.contacts()) {
    Contact contact;
    contact.a = handle(from.a);
    contact.b = handle(from.b);
    const bool turned = contact.b.index < contact.a.index;
    const double sign = turned ? -1 : 1;
    contact.part_a = from.part_a;
    contact.part_b = from.part_b;
    if (turned) {
      std::swap(contact.a, contact.b);
      std::swap(contact.part_a, contact.part_b);
    }
    contact.manifold.normal = sign * axes.space(from.manifold.normal);
    contact.manifold.count = from.manifold.count;
    for (std::size_t i = 0; i < static_cast<std::size_t>(from.manifold.count); ++i) {
      const planar::ContactPoint& point = from.manifold.points[i];
      contact.manifold.points[i] = {axes.space(point.position), point.penetration, point.feature};
    }
    contact.impulse = from.impulse;
    contact.total_impulse = sign * axes.space(from.total_impulse);
    contact.approach_speed = from.approach_speed;
    contact.began = from.began;
    world.planar_contacts.push_back(contact);
  }
  const auto key = [](const Contact& contact) {
    return std::tuple(contact.a.index, contact.b.index, contact.a.generation, contact.b.generation);
  };
  const auto order = [&](const Contact& a, const Contact& b) { return key(a) < key(b); };
  std::sort(world.planar_contacts.begin(), world.planar_contacts.end(), [&](const Contact& a, const Contact& b) {
    return std::tuple(key(a), a.part_a, a.part_b) < std::tuple(key(b), b.part_a, b.part_b);
  });
  world.ended.clear();
  std::swap(world.ended, world.gone_contacts);
  for (std::size_t i = 0; i < before.size(); ++i) {
    // If several parts touched, all of them have separated.
    if (i > 0 && key(before[i - 1]) == key(before[i])) continue;
    if (!std::binary_search(world.planar_contacts.begin(), world.planar_contacts.end(), before[i], order))
      world.ended.push_back({before[i].a, before[i].b});
  }
  std::vector<SensorOverlap> overlaps;
  for (const SensorOverlap& from : world_.sensor_overlaps())
    overlaps.push_back({handle(from.sensor), handle(from.body), from.began});
  const auto in = [](const SensorOverlap& overlap) { return std::pair(overlap.sensor.index, overlap.body.index); };
  std::sort(overlaps.begin(), overlaps.end(), [&](const auto& a, const auto& b) { return in(a) < in(b); });
  world.left_sensors.clear();
  for (const SensorOverlap& old : world.overlaps)
    if (std::none_of(overlaps.begin(), overlaps.end(),
                     [&](const SensorOverlap& now) { return now.sensor == old.sensor && now.body == old.body; }))
      world.left_sensors.push_back(old);
  world.overlaps = std::move(overlaps);
}

void Flat::hand_back(state::WorldState& world) {
  const Axes axes = Axes::of(plane_);
  for (std::uint32_t i = 0; i < world.bodies.size(); ++i) {
    state::Body& body = world.bodies[i];
    if (!body.alive) continue;
    const BodyId id = entries_[i].id;
    const Vec3 reaction = axes.space(world_.reaction(id));
    if (reaction != body.extra.value().reaction) body.extra.own().reaction = reaction;
    body.still_for = world_.still_for(id);
    if (body.immovable()) continue;
    body.saturated = world_.saturated(id);
    body.asleep = world_.asleep(id);
    const planar::Motion motion = world_.motion(id);
    body.motion.pose.position = axes.space(motion.position);
    body.motion.pose.rotation = axes.rotation(motion.angle);
    body.motion.twist = {axes.space(motion.velocity), axes.space(motion.spin)};
    body.follow_motion();
  }
  tell_contacts(world);
}

void Flat::settle(const state::WorldState& world) {
  for (std::uint32_t i = 0; i < world.bodies.size(); ++i)
    if (world.bodies[i].alive) entries_[i].told = world.bodies[i].motion;
}

}  // namespace tweenfall::flat

namespace tweenfall {

void World::Implementation::step_in_plane(double dt) {
  flat::Flat& plane = flat.own();
  plane.take_over(*this);
  push_in_plane(dt);
  note_soft_starts();
  plane.step(dt, part_count);
  plane.hand_back(*this);
  plane.hand_back_joints(*this, dt);
  break_in_plane();
  for (state::Body& body : bodies) {
    if (!body.alive) continue;
    body.placed = body.led = false;
    if (body.immovable()) {
      step::arrive(body);
      continue;
    }
    body.clear_work();
    if (body.drive.owner() == Owner::driven) body.target().twist = {};
    body.has_target = false;
  }
  plane.settle(*this);
  advance_softs(dt, dt * part_count);
  failed = false;
}

}  // namespace tweenfall
