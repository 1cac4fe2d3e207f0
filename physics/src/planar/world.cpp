#include <tweenfall/curves/number_text.h>
#include <tweenfall/physics/planar_world.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "planar/checks.h"
#include "planar/world_data.h"
#include "state/checks.h"

namespace tweenfall::planar {

using inner::Body;
using inner::Joint;
using inner::Makeup;
using inner::Meeting;

Body& World::Implementation::at(BodyId id) {
  if (!(id.index < bodies.size() && bodies[id.index].alive && makeups[id.index].generation == id.generation))
    throw std::invalid_argument("there is no body with index " + std::to_string(id.index) + " and generation " +
                                std::to_string(id.generation) + ": it was removed, or belongs to another world");
  return bodies[id.index];
}
const Body& World::Implementation::at(BodyId id) const {
  return const_cast<Implementation*>(this)->at(id);
}
Joint& World::Implementation::at(JointId id) {
  if (!(id.index < joints.size() && joints[id.index].alive && joints[id.index].generation == id.generation))
    throw std::invalid_argument("there is no joint with index " + std::to_string(id.index) + " and generation " +
                                std::to_string(id.generation) + ": it was removed, or belongs to another world");
  return joints[id.index];
}
const Joint& World::Implementation::at(JointId id) const {
  return const_cast<Implementation*>(this)->at(id);
}

Motion World::Implementation::motion_of(std::uint32_t index) const {
  const Body& body = bodies[index];
  const Makeup& makeup = makeups[index];
  if (!body.movable) return makeup.motion;
  const Vec2 arm = body.turn * makeup.mass.center;
  return {body.center - arm, body.angle, body.velocity_at(-arm), body.spin};
}

void World::Implementation::place(std::uint32_t index, const Motion& motion) {
  Body& body = bodies[index];
  Makeup& makeup = makeups[index];
  makeup.motion = motion;
  makeup.target = {motion.position, motion.angle, Vec2(0, 0), 0};
  body.has_target = false;
  body.angle = motion.angle;
  body.turn = inner::Turn::of(motion.angle);
  const Vec2 arm = body.turn * makeup.mass.center;
  body.center = motion.position + arm;
  body.velocity = motion.velocity + motion.spin * inner::quarter(arm);
  body.spin = motion.spin;
}

void World::Implementation::give_mass(std::uint32_t index) {
  Body& body = bodies[index];
  const Makeup& makeup = makeups[index];
  body.compound = makeup.plates.size() > 1;
  body.skin = makeup.plates[0].skin;
  body.reach = 0;
  body.least = std::numeric_limits<double>::infinity();
  for (const inner::Plate& plate : makeup.plates) {
    if (!plate.endless) body.reach = std::max(body.reach, plate.reach);
    body.least = std::min(body.least, plate.least);
  }
  body.lone = !body.compound && makeup.plates[0].corners.size() == 1 && !makeup.endless();
  body.damped = makeup.linear_damping > 0 || makeup.angular_damping > 0;
  body.driven = makeup.drive.owner() == Owner::driven;
  body.movable = !makeup.fixed && makeup.drive.owner() != Owner::keyed;
  body.inverse_mass = body.movable ? 1 / makeup.mass.mass : 0;
  body.inverse_moment = body.movable ? 1 / makeup.mass.moment : 0;
}

void World::Implementation::wake(std::uint32_t index) {
  Body& body = bodies[index];
  if (body.asleep) --sleepers;
  body.asleep = false;
  bodies[index].still_for = 0;
}

void World::Implementation::wake_neighbors(std::uint32_t index) {
  for (const Meeting& meeting : meetings)
    if (meeting.count > 0 && (meeting.a == index || meeting.b == index))
      wake(meeting.a == index ? meeting.b : meeting.a);
  for (const Joint& joint : joints)
    for (const auto& [one, other] :
         {std::pair(joint.settings.a, joint.settings.b), std::pair(joint.settings.b, joint.settings.a)})
      if (joint.alive && one.index == index && other != BodyId{}) wake(other.index);
}

void World::Implementation::look_again(std::uint32_t index) {
  bodies[index].boxed = false;
}

void World::Implementation::meet_or_not(const inner::Pair& pair) {
  for (const std::uint32_t index : {pair.first, pair.second}) {
    wake(index);
    look_again(index);
  }
  keep_apart();
}

void World::Implementation::keep_apart() {
  kept_apart = ignored;
  for (const Joint& joint : joints) {
    const JointSettings& its = joint.settings;
    if (!joint.alive || its.collide || its.a == BodyId{} || its.b == BodyId{}) continue;
    kept_apart.push_back(std::minmax(its.a.index, its.b.index));
  }
  std::sort(kept_apart.begin(), kept_apart.end());
}

World::World(const WorldSettings& settings) : implementation_(std::make_unique<Implementation>()) {
  inner::demand_settings(settings);
  implementation_->settings = settings;
}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::World(const World& other)
    : implementation_(other.implementation_ ? std::make_unique<Implementation>(*other.implementation_) : nullptr) {
  if (!implementation_) return;
  static_cast<void>(
      implementation_->told.get([&](std::vector<Contact>& contacts) { contacts = other.implementation_->contacts(); }));
}
World& World::operator=(const World& other) {
  if (this != &other) *this = World(other);
  return *this;
}

const World::Implementation& World::inside() const {
  if (!implementation_) throw std::logic_error("this world was moved from: it holds nothing");
  return *implementation_;
}
World::Implementation& World::inside() {
  static_cast<void>(std::as_const(*this).inside());
  return *implementation_;
}

BodyId World::add(const BodySettings& settings) {
  inner::demand_body(settings);
  Implementation& world = inside();
  Makeup makeup;
  makeup.mass = inner::mass_of(settings);
  makeup.shape = settings.shape;
  makeup.plates = inner::plates_of(settings.shape, makeup.mass.center);
  makeup.friction = settings.friction;
  makeup.restitution = settings.restitution;
  makeup.rolling_friction = settings.rolling_friction;
  makeup.friction_combine = settings.friction_combine;
  makeup.restitution_combine = settings.restitution_combine;
  makeup.linear_damping = settings.linear_damping;
  makeup.angular_damping = settings.angular_damping;
  makeup.fixed = settings.fixed;
  makeup.sensor = settings.sensor;
  makeup.groups = settings.groups;
  makeup.collides_with = settings.collides_with;
  makeup.drive = settings.fixed ? Drive::free() : settings.drive;
  std::uint32_t index = 0;
  if (world.unused.empty()) {
    index = static_cast<std::uint32_t>(world.bodies.size());
    world.bodies.emplace_back();
    world.makeups.push_back(std::move(makeup));
  } else {
    index = world.unused.back();
    world.unused.pop_back();
    makeup.generation = world.makeups[index].generation;
    world.bodies[index] = {};
    world.makeups[index] = std::move(makeup);
  }
  Body& body = world.bodies[index];
  body.alive = true;
  Motion motion = settings.motion;
  if (settings.fixed) {
    motion.velocity = Vec2(0, 0);
    motion.spin = 0;
  }
  world.give_mass(index);
  world.place(index, motion);
  return world.handle(index);
}

void World::remove(BodyId id) {
  Implementation& world = inside();
  static_cast<void>(world.at(id));
  static_cast<void>(world.contacts());
  world.wake_neighbors(id.index);
  world.wake(id.index);
  for (std::uint32_t i = 0; i < world.joints.size(); ++i) {
    const Joint& joint = world.joints[i];
    if (joint.alive && (joint.settings.a == id || joint.settings.b == id)) remove_joint({i, joint.generation});
  }
  std::erase_if(world.meetings, [&](const Meeting& meeting) { return meeting.a == id.index || meeting.b == id.index; });
  std::erase_if(world.ignored, [&](const auto& pair) { return pair.first == id.index || pair.second == id.index; });
  world.keep_apart();
  world.near.remove(id.index);
  world.bodies[id.index] = {};
  const std::uint32_t generation = id.generation + 1;
  world.makeups[id.index] = {};
  world.makeups[id.index].generation = generation;
  world.unused.push_back(id.index);
}

bool World::contains(BodyId id) const noexcept {
  if (!implementation_) return false;
  const Implementation& world = *implementation_;
  return id.index < world.bodies.size() && world.bodies[id.index].alive &&
         world.makeups[id.index].generation == id.generation;
}

std::vector<BodyId> World::bodies() const {
  std::vector<BodyId> all;
  for (std::uint32_t i = 0; i < inside().bodies.size(); ++i)
    if (inside().bodies[i].alive) all.push_back(inside().handle(i));
  return all;
}

Motion World::motion(BodyId body) const {
  static_cast<void>(inside().at(body));
  return inside().motion_of(body.index);
}
Vec2 World::center_velocity(BodyId body) const {
  return inside().at(body).velocity;
}
const MassProperties& World::mass(BodyId body) const {
  static_cast<void>(inside().at(body));
  return inside().makeups[body.index].mass;
}
const Shape& World::shape(BodyId body) const {
  static_cast<void>(inside().at(body));
  return inside().makeups[body.index].shape;
}
Owner World::owner(BodyId body) const {
  static_cast<void>(inside().at(body));
  return inside().makeups[body.index].drive.owner();
}
Drive World::drive(BodyId body) const {
  static_cast<void>(inside().at(body));
  return inside().makeups[body.index].drive;
}
bool World::is_fixed(BodyId body) const {
  static_cast<void>(inside().at(body));
  return inside().makeups[body.index].fixed;
}
bool World::is_sensor(BodyId body) const {
  static_cast<void>(inside().at(body));
  return inside().makeups[body.index].sensor;
}
double World::still_for(BodyId body) const {
  return inside().at(body).still_for;
}
bool World::asleep(BodyId body) const {
  return inside().at(body).asleep;
}
bool World::saturated(BodyId body) const {
  static_cast<void>(inside().at(body));
  return inside().makeups[body.index].saturated;
}
Vec2 World::reaction(BodyId body) const {
  static_cast<void>(inside().at(body));
  return inside().makeups[body.index].reaction;
}
double World::kinetic_energy() const {
  double energy = 0;
  for (std::size_t i = 0; i < inside().bodies.size(); ++i) {
    const Body& body = inside().bodies[i];
    if (!body.alive || !body.movable) continue;
    const MassProperties& mass = inside().makeups[i].mass;
    energy += 0.5 * (mass.mass * body.velocity.squaredNorm() + mass.moment * body.spin * body.spin);
  }
  return energy;
}
int World::sub_steps() const noexcept {
  return implementation_ ? implementation_->sub_steps : 0;
}

double World::time() const noexcept {
  return implementation_ ? implementation_->time : 0;
}

void World::set_motion(BodyId id, const Motion& motion) {
  static_cast<void>(inside().at(id));
  inner::demand_motion(motion);
  static_cast<void>(inside().contacts());
  inside().wake_neighbors(id.index);
  inside().wake(id.index);
  Motion its = motion;
  if (inside().makeups[id.index].fixed) {
    its.velocity = Vec2(0, 0);
    its.spin = 0;
  }
  inside().place(id.index, its);
  inside().look_again(id.index);
  inside().failed = false;
}

void World::set_drive(BodyId id, const Drive& drive) {
  Implementation& world = inside();
  static_cast<void>(world.at(id));
  state::validate(drive);
  Makeup& makeup = world.makeups[id.index];
  inner::demand(!makeup.fixed, "a fixed body cannot be handed over");
  inner::demand(drive.owner() == Owner::keyed || !makeup.endless(),
                "a half-plane has no mass: only fixed and keyed bodies can be one");
  const Motion motion = world.motion_of(id.index);
  if (makeup.drive.owner() != drive.owner()) {
    static_cast<void>(world.contacts());
    for (Meeting& meeting : world.meetings)
      if (meeting.a == id.index || meeting.b == id.index) {
        meeting.pressing = meeting.dragging = {};
        meeting.rolling = 0;
      }
    makeup.drive = drive;
    world.give_mass(id.index);
    const bool keeps = world.bodies[id.index].has_target;
    const Motion target = makeup.target;
    world.place(id.index, motion);
    if (keeps) {
      world.bodies[id.index].has_target = true;
      makeup.target = target;
    }
    world.look_again(id.index);
  }
  makeup.drive = drive;
  world.give_mass(id.index);
  world.wake_neighbors(id.index);
  world.wake(id.index);
}

void World::set_target(BodyId id, const Motion& end_of_step) {
  static_cast<void>(inside().at(id));
  inner::demand_motion(end_of_step);
  Makeup& makeup = inside().makeups[id.index];
  makeup.target = end_of_step;
  inside().bodies[id.index].has_target = true;
  if (makeup.drive.owner() == Owner::driven) inside().wake(id.index);
}

void World::apply_force(BodyId id, const Vec2& force, const Vec2& point) {
  Body& body = inside().at(id);
  inner::demand_numbers(force, "force");
  inner::demand_numbers(point, "point of a force");
  body.force += force;
  body.torque += inner::cross(point - body.center, force);
}

void World::apply_torque(BodyId id, double torque) {
  Body& body = inside().at(id);
  inner::demand_number(torque, "torque");
  body.torque += torque;
}

void World::apply_impulse(BodyId id, const Vec2& impulse, const Vec2& point) {
  Body& body = inside().at(id);
  inner::demand_numbers(impulse, "impulse");
  inner::demand_numbers(point, "point of an impulse");
  body.velocity += body.inverse_mass * impulse;
  body.spin += body.inverse_moment * inner::cross(point - body.center, impulse);
  inside().wake(id.index);
}

void World::wake(BodyId id) {
  static_cast<void>(inside().at(id));
  inside().wake(id.index);
}

void World::set_groups(BodyId id, std::uint64_t groups, std::uint64_t collides_with) {
  static_cast<void>(inside().at(id));
  Makeup& makeup = inside().makeups[id.index];
  makeup.groups = groups;
  makeup.collides_with = collides_with;
  inside().wake_neighbors(id.index);
  inside().wake(id.index);
  inside().look_again(id.index);
}

void World::ignore(BodyId a, BodyId b) {
  Implementation& world = inside();
  static_cast<void>(world.at(a));
  static_cast<void>(world.at(b));
  inner::demand(a != b, "a body cannot ignore itself");
  const inner::Pair pair = std::minmax(a.index, b.index);
  const auto place = std::lower_bound(world.ignored.begin(), world.ignored.end(), pair);
  if (place != world.ignored.end() && *place == pair) return;
  world.ignored.insert(place, pair);
  world.meet_or_not(pair);
}

void World::collide(BodyId a, BodyId b) {
  Implementation& world = inside();
  static_cast<void>(world.at(a));
  static_cast<void>(world.at(b));
  const inner::Pair pair = std::minmax(a.index, b.index);
  if (std::erase(world.ignored, pair) > 0) world.meet_or_not(pair);
}

std::span<const Contact> World::contacts() const noexcept {
  if (!implementation_) return {};
  return implementation_->contacts();
}
std::span<const EndedContact> World::ended_contacts() const noexcept {
  if (!implementation_) return {};
  return implementation_->ended;
}
std::span<const SensorOverlap> World::sensor_overlaps() const noexcept {
  if (!implementation_) return {};
  return implementation_->overlaps;
}

void World::step(double dt) {
  inside().step(dt, 1);
}

void World::step(double dt, double whole) {
  if (!std::isfinite(whole))
    throw std::invalid_argument("the step of which this is a part must be finite, but is " + number_text(whole) + " s");
  inside().step(dt, std::max(1.0, whole / dt));
}

}  // namespace tweenfall::planar
