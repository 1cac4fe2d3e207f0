#include <tweenfall/physics/world.h>

#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "state/checks.h"
#include "state/countable.h"
#include "state/world_data.h"

namespace tweenfall {

namespace state {
namespace {

/// From here on it is not led anywhere until a new target is set.
void stay(Body& body) {
  if (body.drive.owner() == Owner::free && !body.fixed && !body.extra.has_value()) return;
  body.target() = body.motion;
  body.target().twist = {};
}

void clear_work(Body& body) {
  body.clear_work();
  body.has_target = false;
}

}  // namespace
}  // namespace state

state::Body& World::Implementation::at(BodyId id) {
  // The text is only built when needed: this is asked for every body in every step.
  if (!(id.index < bodies.size() && bodies[id.index].alive && bodies[id.index].generation == id.generation))
    throw std::invalid_argument("there is no body with index " + std::to_string(id.index) + " and generation " +
                                std::to_string(id.generation) + ": it was removed, or belongs to another world");
  return bodies[id.index];
}
const state::Body& World::Implementation::at(BodyId id) const {
  return const_cast<Implementation*>(this)->at(id);
}

void World::Implementation::wake(std::uint32_t index) {
  bodies[index].asleep = false;
  bodies[index].still_for = 0;
}

void World::Implementation::drop_contacts(std::uint32_t index) {
  const auto from = static_cast<std::ptrdiff_t>(gone_contacts.size());
  for (const std::uint32_t place : memories.of(index)) {
    const state::ContactMemory& memory = memories[place];
    if (memory.is(state::ContactMemory::touching) && !memory.is(state::ContactMemory::gone))
      gone_contacts.push_back({{memory.a, bodies[memory.a].generation}, {memory.b, bodies[memory.b].generation}});
    memories.part(place);
  }
  std::erase_if(planar_contacts, [&](const Contact& contact) {
    const bool goes = contact.a.index == index || contact.b.index == index;
    if (goes) gone_contacts.push_back({contact.a, contact.b});
    return goes;
  });
  // Bodies that touched with several parts ended one contact.
  const auto pair_of = [](const EndedContact& contact) { return pairs::Pair(contact.a.index, contact.b.index); };
  std::ranges::sort(gone_contacts.begin() + from, gone_contacts.end(), {}, pair_of);
  const auto same = [&](const EndedContact& one, const EndedContact& next) { return pair_of(one) == pair_of(next); };
  gone_contacts.erase(std::unique(gone_contacts.begin() + from, gone_contacts.end(), same), gone_contacts.end());
  told.forget();
}

void World::Implementation::wake_neighbors(std::uint32_t index) {
  for (const std::uint32_t place : memories.of(index)) {
    const state::ContactMemory& memory = memories[place];
    const std::uint32_t other = memory.a == index ? memory.b : memory.a;
    if (!memory.is(state::ContactMemory::gone) && !bodies[other].immovable()) wake(other);
  }
}

void World::Implementation::meet_or_not(std::uint32_t a, std::uint32_t b) {
  broad_phase.look_again(a);
  for (const std::uint32_t end : {a, b})
    if (!bodies[end].immovable()) wake(end);
}

void World::Implementation::forget_impulses(std::uint32_t index) {
  for (const std::uint32_t place : memories.of(index)) {
    state::ContactMemory& memory = memories[place];
    if (state::MoreOfContact* more = memories.more(memory)) more->kept_twist = 0;
    if (state::RareOfContact* rare = memories.rare(memory)) {
      rare->kept_rolling = Vec3::Zero();
      rare->kept_spin = 0;
    }
    for (std::size_t i = 0; i < memory.count; ++i) {
      memories.point(memory, i).kept_normal = 0;
      memories.point(memory, i).kept_friction = Vec3::Zero();
    }
  }
}

World::World(const WorldSettings& settings) : implementation_(std::make_unique<Implementation>()) {
  state::validate(settings);
  implementation_->settings = settings;
  if (settings.plane != WorldPlane::none) implementation_->flat.own().begin(settings);
  if (settings.threads > 1)
    implementation_->executor = std::make_shared<ThreadPool>(static_cast<std::size_t>(settings.threads));
}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::World(const World& other)
    : implementation_(other.implementation_
                          ? std::make_unique<Implementation>(*other.implementation_, other.implementation_->executor)
                          : nullptr) {}
World& World::operator=(const World& other) {
  if (this == &other) return *this;
  if (implementation_ && implementation_->stepping) throw std::logic_error("a field cannot assign to its world");
  if (implementation_ && other.implementation_) {
    const state::WorldState& state = *other.implementation_;
    *implementation_ = state;  // keeps the capacity that is there
    implementation_->executor = other.implementation_->executor;
  } else {
    *this = World(other);
  }
  return *this;
}

const World::Implementation& World::inside() const {
  if (!implementation_) throw std::logic_error("this world was moved from: it holds nothing");
  return *implementation_;
}
World::Implementation& World::changing() {
  static_cast<void>(inside());
  if (implementation_->stepping) throw std::logic_error("a field cannot change the world that it acts in");
  implementation_->scene.forget();
  return *implementation_;
}

BodyId World::add(const BodySettings& settings) {
  Implementation& world = changing();
  state::validate(settings.drive);
  state::Body body;
  body.fixed = settings.fixed;
  body.drive = settings.drive;
  body.set_filter({settings.groups, settings.collides_with});
  state::Makeup makeup;
  makeup.shape = settings.shape;
  makeup.friction = settings.friction;
  makeup.restitution = settings.restitution;
  makeup.rolling_friction = settings.rolling_friction;
  makeup.spinning_friction = settings.spinning_friction;
  makeup.friction_combine = settings.friction_combine;
  makeup.restitution_combine = settings.restitution_combine;
  makeup.sensor = settings.sensor;
  makeup.collision = settings.collision;
  makeup.linear_damping = settings.linear_damping;
  makeup.angular_damping = settings.angular_damping;
  state::validate_surface(makeup);
  state::validate_surface(settings.surface_velocity);
  state::give_mass(makeup, body.immovable(), settings.mass, settings.density, settings.mass_properties);
  flat::require_body(world.settings.plane, settings);
  body.makeup = world.makeups.share(makeup);
  body.conveys = state::conveys(settings.surface_velocity);
  if (body.conveys) body.extra.own().surface_velocity = settings.surface_velocity;
  body.motion = state::checked(settings.motion);
  if (body.fixed) {
    body.motion.twist = {};
    body.motion.scale_rate = Vec3::Zero();
  }
  body.follow_motion();
  state::stay(body);
  body.alive = true;

  std::uint32_t index = 0;
  if (world.unused.empty()) {
    index = static_cast<std::uint32_t>(world.bodies.size());
    world.bodies.push_back(body);
  } else {
    index = world.unused.back();
    world.unused.pop_back();
    body.generation = world.bodies[index].generation;
    world.bodies[index] = body;
  }
  world.note(index);
  if (state::asks_for_other_detection(makeup)) ++world.other_detections;
  if (body.sensor()) world.sensors.insert(std::lower_bound(world.sensors.begin(), world.sensors.end(), index), index);
  return {index, world.bodies[index].generation};
}

void World::remove(BodyId id) {
  Implementation& world = changing();
  state::Body& body = world.at(id);
  world.wake_neighbors(id.index);
  world.wake_forced(id);
  world.remove_joints_of(id.index);
  for (soft::SoftBody& soft : world.softs)
    std::erase_if(soft.pins, [&](const soft::PinState& state) { return state.pin.body == id; });
  world.drop_contacts(id.index);
  if (body.sensor()) std::erase(world.sensors, id.index);
  if (state::asks_for_other_detection(*body.makeup)) --world.other_detections;
  body.alive = false;
  ++body.generation;
  world.broad_phase.remove(id.index);
  world.ignored.remove(id.index);
  world.unused.push_back(id.index);
}

bool World::contains(BodyId id) const noexcept {
  if (!implementation_) return false;
  const auto& bodies = implementation_->bodies;
  return id.index < bodies.size() && bodies[id.index].alive && bodies[id.index].generation == id.generation;
}

std::vector<BodyId> World::bodies() const {
  std::vector<BodyId> result;
  const auto& all = inside().bodies;
  for (std::uint32_t i = 0; i < all.size(); ++i)
    if (all[i].alive) result.push_back({i, all[i].generation});
  return result;
}

Motion World::motion(BodyId id) const {
  return inside().at(id).motion;
}
Twist World::twist(BodyId id) const {
  return inside().at(id).twist;
}
const MassProperties& World::mass(BodyId id) const {
  return inside().at(id).mass();
}
const Shape& World::shape(BodyId id) const {
  return inside().at(id).shape();
}
Owner World::owner(BodyId id) const {
  return inside().at(id).drive.owner();
}
Drive World::drive(BodyId id) const {
  return inside().at(id).drive;
}
bool World::is_fixed(BodyId id) const {
  return inside().at(id).fixed;
}
bool World::is_sensor(BodyId id) const {
  return inside().at(id).sensor();
}
double World::still_for(BodyId id) const {
  return inside().at(id).still_for;
}
bool World::asleep(BodyId id) const {
  return inside().at(id).asleep;
}

bool World::saturated(BodyId body) const {
  return inside().at(body).saturated;
}
bool World::squeezed(BodyId body) const {
  return inside().at(body).squeezed;
}
Vec3 World::reaction(BodyId id) const {
  return inside().at(id).extra.value().reaction;
}
double World::time() const noexcept {
  return implementation_ ? implementation_->time : 0;
}

double World::kinetic_energy() const {
  double sum = 0;
  for (const state::Body& body : inside().bodies) {
    if (!body.alive || body.immovable()) continue;
    const Vec3 momentum = body.world_inertia(body.motion.pose.rotation) * body.twist.angular;
    sum += 0.5 * body.mass().mass * body.twist.linear.squaredNorm() + 0.5 * body.twist.angular.dot(momentum);
  }
  return sum;
}

void World::set_motion(BodyId id, const Motion& motion) {
  Implementation& world = changing();
  state::Body& body = world.at(id);
  const Motion wanted = state::checked(motion);
  flat::require_motion(world.settings.plane, wanted);
  world.wake_neighbors(id.index);
  world.wake_jointed(id.index);
  world.wake(id.index);
  world.forget_impulses(id.index);
  world.note(id.index);
  body.motion = wanted;
  body.placed = true;
  if (body.fixed) {
    body.motion.twist = {};
    body.motion.scale_rate = Vec3::Zero();
  }
  body.has_target = false;
  state::stay(body);
  body.follow_motion();
}

void World::set_drive(BodyId id, const Drive& drive) {
  Implementation& world = changing();
  state::Body& body = world.at(id);
  state::validate(drive);
  if (body.drive == drive) return;
  state::require(
      drive.owner() == Owner::keyed || body.fixed || body.mass().mass > 0,
      std::string("a body with ") + kind_name(body.shape().solid) + " must stay fixed or keyed: it has no mass");
  const Owner before = body.drive.owner();
  body.drive = drive;
  if (before == drive.owner() && before != Owner::driven) return;  // only numbers that this owner does not use
  if (before == drive.owner()) {
    world.wake(id.index);
    return;
  }
  body.saturated = false;
  state::clear_work(body);
  world.note(id.index);
  state::stay(body);
  body.motion.scale_rate = drive.owner() == Owner::keyed ? body.motion.scale_rate : Vec3(0, 0, 0);
  world.forget_impulses(id.index);
  body.placed = true;
  world.wake_neighbors(id.index);
  world.wake_jointed(id.index);
  world.wake(id.index);
}

void World::set_target(BodyId id, const Motion& end_of_step) {
  Implementation& world = changing();
  state::Body& body = world.at(id);
  state::require(!body.fixed, "a fixed body takes no target: it never moves");
  state::require(body.drive.owner() != Owner::free,
                 "a free body takes no target: only keyed and driven bodies have one");
  const Motion wanted = state::checked(end_of_step);
  flat::require_motion(world.settings.plane, wanted);
  Motion& target = body.target();
  const Pose before = target.pose;
  target = wanted;
  body.has_target = true;
  world.note(id.index);
  if (body.drive.owner() != Owner::driven) return;
  body.led = body.led || target.pose.position != before.position ||
             target.pose.rotation.coeffs() != before.rotation.coeffs() || target.twist.linear != Vec3::Zero() ||
             target.twist.angular != Vec3::Zero();
  if (body.led) world.wake(id.index);
}

void World::set_surface_velocity(BodyId id, const Twist& velocity) {
  Implementation& world = changing();
  state::Body& body = world.at(id);
  state::validate_surface(velocity);
  if (state::conveys(velocity)) flat::refuse(world.settings.plane, "moving surfaces");
  const Twist& before = body.extra.value().surface_velocity;
  if (before.linear == velocity.linear && before.angular == velocity.angular) return;
  body.extra.own().surface_velocity = velocity;
  body.conveys = state::conveys(velocity);
  world.wake_neighbors(id.index);
  world.wake(id.index);
}

Twist World::surface_velocity(BodyId id) const {
  return inside().at(id).extra.value().surface_velocity;
}

void World::set_groups(BodyId id, std::uint64_t groups, std::uint64_t collides_with) {
  Implementation& world = changing();
  state::Body& body = world.at(id);
  if (body.groups() == groups && body.collides_with() == collides_with) return;
  world.wake_neighbors(id.index);
  world.wake(id.index);
  world.note(id.index);
  body.set_filter({groups, collides_with});
  body.placed = true;
  world.broad_phase.look_again(id.index);
}

std::uint64_t World::groups(BodyId id) const {
  return inside().at(id).groups();
}
std::uint64_t World::collides_with(BodyId id) const {
  return inside().at(id).collides_with();
}

void World::ignore(BodyId a, BodyId b) {
  Implementation& world = changing();
  world.at(a);
  world.at(b);
  state::require(a != b, "a body cannot ignore itself");
  if (world.ignored.ask(a.index, b.index, true)) world.meet_or_not(a.index, b.index);
}

void World::collide(BodyId a, BodyId b) {
  Implementation& world = changing();
  world.at(a);
  world.at(b);
  state::require(a != b, "a body cannot collide with itself");
  if (world.ignored.ask(a.index, b.index, false)) world.meet_or_not(a.index, b.index);
}

bool World::collides(BodyId a, BodyId b) const {
  const Implementation& world = inside();
  world.at(a);
  world.at(b);
  return a != b && pairs::PairFilter{world.bodies, world.ignored}.lets(a.index, b.index);
}

void World::apply_force(BodyId id, const Vec3& force, const Vec3& point) {
  Implementation& world = changing();
  state::Body& body = world.at(id);
  state::require_finite(force, "force");
  state::require_finite(point, "point");
  if (body.immovable()) return;
  world.wake(id.index);
  state::Work& work = body.work.own();
  work.force += force;
  work.torque += (point - body.center).cross(force);
}

void World::apply_torque(BodyId id, const Vec3& torque) {
  Implementation& world = changing();
  state::Body& body = world.at(id);
  state::require_finite(torque, "torque");
  if (body.immovable()) return;
  world.wake(id.index);
  body.work.own().torque += torque;
}

void World::apply_impulse(BodyId id, const Vec3& impulse, const Vec3& point) {
  Implementation& world = changing();
  state::Body& body = world.at(id);
  state::require_finite(impulse, "impulse");
  state::require_finite(point, "point");
  if (body.immovable()) return;
  Twist twist = body.twist;
  twist.linear += impulse / body.mass().mass;
  twist.angular += body.world_inverse_inertia(body.motion.pose.rotation) * (point - body.center).cross(impulse);
  const Twist at_origin = shifted(twist, body.motion.pose.position - body.center);
  state::require(
      state::countable(twist.linear) && state::countable(twist.angular) && state::countable(at_origin.linear),
      "the impulse would make the body faster than 1e30 m/s or rad/s");
  world.wake(id.index);
  body.twist = twist;
  body.motion.twist = at_origin;
}

void World::wake(BodyId id) {
  Implementation& world = changing();
  world.at(id);
  world.wake(id.index);
}

void World::set_executor(std::shared_ptr<Executor> executor) {
  changing().executor = std::move(executor);
}

void World::step(double dt) {
  if (!(dt > 0 && std::isfinite(dt)))
    throw std::invalid_argument("a step must be positive and finite, but is " + number_text(dt) + " s");
  changing().step(dt, 1);
}

void World::step(double dt, double whole) {
  if (!(dt > 0 && std::isfinite(dt)) || !std::isfinite(whole))
    throw std::invalid_argument("a part of a step must be positive, and the whole step finite, but this is " +
                                number_text(dt) + " s of " + number_text(whole) + " s");
  // A step that only rounding made shorter is a whole one.
  constexpr double rounding = 1e-6;
  const double parts = whole / dt;
  changing().step(dt, parts > 1 + rounding ? parts : 1);
}

std::span<const EndedContact> World::ended_contacts() const noexcept {
  return implementation_ ? std::span<const EndedContact>(implementation_->ended) : std::span<const EndedContact>();
}

std::span<const SensorOverlap> World::sensor_overlaps() const noexcept {
  return implementation_ ? std::span<const SensorOverlap>(implementation_->overlaps) : std::span<const SensorOverlap>();
}

std::span<const SensorOverlap> World::ended_sensor_overlaps() const noexcept {
  return implementation_ ? std::span<const SensorOverlap>(implementation_->left_sensors)
                         : std::span<const SensorOverlap>();
}

std::span<const Contact> World::contacts() const noexcept {
  if (!implementation_) return {};
  if (implementation_->flat.has_value()) return implementation_->planar_contacts;
  return implementation_->told.get([this](std::vector<Contact>& all) { implementation_->tell_contacts(all); });
}

}  // namespace tweenfall
