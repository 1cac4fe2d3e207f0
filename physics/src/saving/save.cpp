#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "collision/surfaces/surface.h"
#include "joints/validate.h"
#include "saving/bytes.h"
#include "saving/envelope.h"
#include "state/checks.h"
#include "state/countable.h"
#include "state/makeups.h"
#include "state/world_data.h"

namespace tweenfall {

namespace saving {
namespace {

constexpr Envelope world_envelope{"world", 12};

bool unit(const Quat& rotation) {
  return std::abs(rotation.norm() - 1) <= 1e-9;
}

// Impulses and distances between bodies may be larger than what a world accepts from its caller.
void require_number(double value, const char* name) {
  state::require(std::isfinite(value), std::string(name) + " must be a finite number");
}
void require_numbers(const Vec3& value, const char* name) {
  state::require(value.allFinite(), std::string(name) + " must be finite numbers");
}

/// Also sets what follows from the rest.
void check(Body& body, state::Makeups& makeups) {
  Makeup makeup = *body.makeup;
  const Extra& extra = body.extra.value();
  state::validate_surface(makeup);
  state::validate_surface(extra.surface_velocity);
  body.conveys = state::conveys(extra.surface_velocity);
  state::validate(body.drive);
  state::require(unit(makeup.shape.offset.rotation), "rotation of a shape must be a unit quaternion");
  const std::optional<double> mass = makeup.weighed ? std::nullopt : std::optional(makeup.mass.mass);
  const std::optional<MassProperties> weighed = makeup.weighed ? std::optional(makeup.mass) : std::nullopt;
  makeup.mass = {};
  state::give_mass(makeup, body.immovable(), mass, 0, weighed);
  body.makeup = makeups.share(makeup);
  for (const Motion& motion : {body.motion, extra.target}) {
    static_cast<void>(state::checked(motion));
    state::require(unit(motion.pose.rotation), "rotation of a body must be a unit quaternion");
  }
  state::require(body.finite(), "its place and velocity must be finite and at most 1e30");
  state::require(body.force().allFinite() && body.torque().allFinite() && extra.reaction.allFinite(),
                 "its forces must be finite");
  state::require_amount(body.still_for, "time of stillness");
  state::require(body.across() == Vec3::Zero() || std::abs(body.across().norm() - 1) <= 1e-12,
                 "the normal of its plane must have length 1 or 0");
}

void check(const Stand& stand) {
  require_numbers(stand.center, "place of a body");
  state::require(unit(stand.rotation), "its rotations must be unit quaternions");
}

void check(const WholeContact& contact) {
  const auto& [memory, more, rare] = contact;
  state::require(memory.count >= 1 && memory.count <= 4, "it must have 1 to 4 points");
  constexpr int known = ContactMemory::touching | ContactMemory::began | ContactMemory::slid | ContactMemory::holds |
                        ContactMemory::taken_up | ContactMemory::within;
  state::require((memory.marks & ~known) == 0, "there are no such marks");
  state::require(memory.is(ContactMemory::holds) || !memory.is(ContactMemory::taken_up), "what was taken up must hold");
  state::require(std::abs(memory.normal.norm() - 1) <= 1e-6, "its normal must have length 1");
  for (std::size_t i = 0; i < memory.count; ++i) {
    const PointMemory& point = i == 0 ? memory.first : more.points[i - 1];
    require_numbers(point.position, "place of a point");
    require_number(point.penetration, "depth of a point");
    require_number(point.kept_normal, "impulse of a point");
    require_numbers(point.kept_friction, "friction of a point");
    require_numbers(rare.arms_b[i], "arm of a point");
  }
  state::require(memory.impulse >= 0 && std::isfinite(memory.impulse) && memory.total_impulse.allFinite(),
                 "its impulses must be finite");
  state::require(memory.approach >= 0 && std::isfinite(memory.approach), "its approach speed must be finite");
  require_numbers(rare.kept_rolling, "rolling impulse");
  require_number(rare.kept_spin, "spinning impulse");
  require_number(memory.kept_step, "length of a sub-step");
  state::require(memory.kept_step >= 0 && rare.passed_over >= 0, "its times must not be negative");
  require_number(more.kept_twist, "twisting impulse");
  require_number(rare.passed_over, "time passed over");
  if (!memory.is(ContactMemory::holds)) return;
  check(more.a);
  check(more.b);
}

void check(const Contact& contact) {
  state::require(contact.manifold.count >= 1 && contact.manifold.count <= 4, "it must have 1 to 4 points");
  state::require(std::abs(contact.manifold.normal.norm() - 1) <= 1e-6, "its normal must have length 1");
  for (std::size_t i = 0; i < within_four(contact.manifold.count); ++i) {
    state::require(contact.manifold.points[i].position.allFinite(), "its points must be finite");
    state::require(std::isfinite(contact.manifold.points[i].penetration), "its points must be finite");
  }
  state::require(contact.impulse >= 0 && std::isfinite(contact.impulse) && contact.total_impulse.allFinite(),
                 "its impulses must be finite");
  state::require(contact.approach_speed >= 0 && std::isfinite(contact.approach_speed),
                 "its approach speed must be finite");
}

/// Runs a check, and puts the place of what is checked in front of its message.
template <class Check>
void at(const std::string& place, const Check& check_it) {
  try {
    check_it();
  } catch (const std::invalid_argument& fault) {
    throw std::invalid_argument("a saved world has a bad " + place + ": " + fault.what());
  }
}

/// Bodies and their parts.
using PartPair = std::array<std::uint32_t, 4>;

bool in_order(const PartPair& pair, const PartPair* before) {
  return pair[0] < pair[1] && (!before || *before < pair);
}

void check_bodies(WorldState& world) {
  std::vector<char> free(world.bodies.size(), 0);
  state::Makeups makeups;
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    if (!world.bodies[i].alive) {
      free[i] = 1;
      continue;
    }
    at("body " + std::to_string(i), [&] { check(world.bodies[i], makeups); });
    if (state::asks_for_other_detection(*world.bodies[i].makeup)) ++world.other_detections;
    if (world.bodies[i].sensor()) world.sensors.push_back(static_cast<std::uint32_t>(i));
  }
  for (const std::uint32_t index : world.unused) {
    state::require(index < free.size() && free[index] != 0, "a saved world has a bad list of free places");
    free[index] = 0;
  }
  state::require(std::ranges::count(free, 1) == 0, "a saved world has a bad list of free places");
}

void check(const Joint& joint, const WorldState& world) {
  const JointSettings& settings = joint.settings;
  const auto here = [&](const BodyId& id) {
    return id.index < world.bodies.size() && world.bodies[id.index].alive &&
           world.bodies[id.index].generation == id.generation;
  };
  state::require(here(settings.b) && (settings.a == BodyId{} || here(settings.a)) && settings.a != settings.b,
                 "there are no such bodies");
  static_cast<void>(joints::checked(settings));
  state::require(unit(settings.frame_a.rotation) && unit(settings.frame_b.rotation),
                 "rotation of a joint's frame must be a unit quaternion");
  if (const auto* limb = std::get_if<SwingTwistJoint>(&settings.kind); limb && limb->toward)
    state::require(unit(*limb->toward), "the rotation that a joint is turned to must be a unit quaternion");
  if (const auto* pulley = std::get_if<PulleyJoint>(&settings.kind))
    state::require(pulley->length.has_value(), "a pulley's rope must have a length");
  for (const double impulse : joint.kept) require_number(impulse, "impulse");
  for (const double angle : joint.angles) state::require_amount(std::abs(angle), "angle");
  state::require(joint.kept_step >= 0 && std::isfinite(joint.kept_step) && joint.passed_over >= 0 &&
                     std::isfinite(joint.passed_over),
                 "its times must not be negative");
  state::require(joint.side.allFinite() && joint.side.norm() <= 1 + 1e-6, "its side must be a unit vector or 0");
  require_numbers(joint.force, "force");
  require_numbers(joint.torque, "torque");
}

void check_joints(const WorldState& world) {
  std::vector<char> free(world.joints.size(), 0);
  for (std::size_t i = 0; i < world.joints.size(); ++i) {
    if (world.joints[i].alive)
      at("joint " + std::to_string(i), [&] { check(world.joints[i], world); });
    else
      free[i] = 1;
  }
  for (const std::uint32_t index : world.unused_joints) {
    state::require(index < free.size() && free[index] != 0, "a saved world has a bad list of free joints");
    free[index] = 0;
  }
  state::require(std::ranges::count(free, 1) == 0, "a saved world has a bad list of free joints");
}

void check_pairs(const WorldState& world) {
  const auto here = [&](std::uint32_t index) { return index < world.bodies.size() && world.bodies[index].alive; };
  PartPair before{};
  bool first = true;
  const auto has_part = [&](std::uint32_t body, std::uint32_t part) {
    const Solid& solid = world.bodies[body].shape().solid;
    const auto* compound = std::get_if<Compound>(&solid);
    return surfaces::surface_of(solid) ? part < 64 : part < (compound ? compound->parts().size() : 1);
  };
  const auto require_pair = [&](const PartPair& pair) {
    state::require(here(pair[0]) && here(pair[1]), "there are no such bodies");
    state::require(has_part(pair[0], pair[2]) && has_part(pair[1], pair[3]), "there are no such parts");
    state::require(in_order(pair, first ? nullptr : &before), "pairs must come in order");
    before = pair;
    first = false;
  };
  for (std::size_t i = 0; i < world.planar_contacts.size(); ++i)
    at("contact " + std::to_string(i), [&] {
      const Contact& contact = world.planar_contacts[i];
      require_pair({contact.a.index, contact.b.index, contact.part_a, contact.part_b});
      state::require(world.bodies[contact.a.index].generation == contact.a.generation &&
                         world.bodies[contact.b.index].generation == contact.b.generation,
                     "there are no such bodies");
      check(contact);
    });
  first = true;
  std::size_t number = 0;
  for (const std::uint32_t place : world.memories.sorted())
    at("contact " + std::to_string(number++), [&] {
      const WholeContact contact = world.memories.whole(place);
      require_pair({contact.memory.a, contact.memory.b, contact.rare.part_a, contact.rare.part_b});
      state::require(contact.memory.b < world.stands.size(), "the positions of its bodies are missing");
      check(contact);
    });
  first = true;
  for (std::size_t i = 0; i < world.ignored.all().size(); ++i)
    at("ignored pair " + std::to_string(i), [&] {
      const IgnoredPairs::Entry& pair = world.ignored.all()[i];
      require_pair({pair.a, pair.b, 0, 0});
      state::require(pair.asked || pair.holders > 0, "nothing ignores it");
    });
}

void check(soft::SoftBody& body, const WorldState& world) {
  state::require(body.made->solver == SoftSolver::positions || body.made->solver == SoftSolver::springs,
                 "there is no such solver");
  static_cast<void>(soft::checked(*body.made));
  const std::size_t nodes = body.made->positions.size();
  state::require(body.positions.size() == nodes && body.velocities.size() == nodes &&
                     body.torn.size() == body.made->edges.size() && body.made->pins.empty() && body.made->sub_step &&
                     body.made->iterations,
                 "the numbers of its nodes and edges have changed");
  state::require(body.pace > 0 && state::countable(body.pace), "its sub-steps are no time");
  for (std::size_t i = 0; i < nodes; ++i) {
    state::require_finite(body.positions[i], "place of a node");
    state::require_finite(body.velocities[i], "velocity of a node");
  }
  for (std::size_t i = 0; i < body.pins.size(); ++i) {
    const soft::PinState& state = body.pins[i];
    state::require(state.pin.node < nodes && (i == 0 || body.pins[i - 1].pin.node < state.pin.node),
                   "its pins must be in order of nodes");
    const BodyId& holder = state.pin.body;
    state::require(holder == BodyId{} || (holder.index < world.bodies.size() && world.bodies[holder.index].alive &&
                                          world.bodies[holder.index].generation == holder.generation),
                   "there are no such bodies");
    for (const Vec3& value : {state.pin.point, state.target, state.velocity})
      state::require_finite(value, "place of a pin");
    require_numbers(state.force, "force of a pin");
  }
  soft::find_gone(body);
}

void check_softs(WorldState& world) {
  std::vector<char> free(world.softs.size(), 0);
  for (std::size_t i = 0; i < world.softs.size(); ++i) {
    if (world.softs[i].alive)
      at("soft body " + std::to_string(i), [&] { check(world.softs[i], world); });
    else
      free[i] = 1;
  }
  for (const std::uint32_t index : world.unused_softs) {
    state::require(index < free.size() && free[index] != 0, "a saved world has a bad list of free soft bodies");
    free[index] = 0;
  }
  state::require(std::ranges::count(free, 1) == 0, "a saved world has a bad list of free soft bodies");
}

/// Also sets what follows from the rest.
void check(WorldState& world) {
  at("setting", [&] { state::validate(world.settings); });
  state::require(world.time >= 0 && std::isfinite(world.time), "a saved world has a bad time");
  check_bodies(world);
  std::uint64_t least = 0;
  for (const forces::NumberedForce& entry : world.forces)
    at("force " + std::to_string(entry.number), [&] {
      state::validate(entry.force);
      state::require(entry.number >= least && entry.number < world.next_force, "numbers of forces must come in order");
      least = entry.number + 1;
    });
  state::require(world.stands.size() <= world.bodies.size(), "a saved world lists bodies that do not exist");
  for (std::size_t i = 0; i < world.stands.size(); ++i)
    at("place of body " + std::to_string(i), [&] { check(world.stands[i]); });
  check_pairs(world);
  check_joints(world);
  check_softs(world);
}

}  // namespace
}  // namespace saving

std::vector<std::byte> World::save() const {
  const state::WorldState& world = inside();
  for (std::size_t i = 0; i < world.bodies.size(); ++i)
    state::require(!world.bodies[i].alive || world.bodies[i].finite(),
                   "a world whose body " + std::to_string(i) + " is not finite cannot be saved");
  saving::ByteWriter contents;
  walk(contents, world);
  if (world.flat.has_value()) world.flat.value().write(contents);
  return saving::sealed(saving::world_envelope, contents.bytes);
}

void World::load(std::span<const std::byte> saved) {
  const Implementation& before = changing();
  saving::ByteReader reader(saving::opened(saving::world_envelope, saved), "world");
  state::WorldState loaded;
  walk(reader, loaded);
  if (loaded.settings.plane != WorldPlane::none) loaded.flat.own().read(reader);
  reader.require(reader.at_end(), "there is more data than a world");
  saving::check(loaded);
  if (loaded.flat.has_value()) loaded.flat.own().check(loaded);
  loaded.settings.threads = before.settings.threads;
  implementation_ = std::make_unique<Implementation>(std::move(loaded), before.executor);
}

}  // namespace tweenfall
