#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "actors/soft/energies.h"
#include "actors/soft/soft_state.h"
#include "flat/flat.h"
#include "state/checks.h"
#include "state/countable.h"
#include "state/world_data.h"

namespace tweenfall {

namespace soft {

/// Access of these functions to a world.
class Inside {
 public:
  [[nodiscard]] static const World::Implementation& of(const World& world) { return world.inside(); }
  [[nodiscard]] static World::Implementation& changing(World& world) { return world.changing(); }
};

namespace {

const SoftBody& at(const World& world, SoftId id) {
  const std::vector<SoftBody>& all = Inside::of(world).softs;
  if (!(id.index < all.size() && all[id.index].alive && all[id.index].generation == id.generation))
    throw std::invalid_argument("there is no soft body with index " + std::to_string(id.index) + " and generation " +
                                std::to_string(id.generation) + ": it was removed, or belongs to another world");
  return all[id.index];
}
SoftBody& changing(World& world, SoftId id) {
  static_cast<void>(at(world, id));
  return Inside::changing(world).softs[id.index];
}

void require_node(const SoftBody& body, std::uint32_t node) {
  state::require(node < body.positions.size(), "there is no node " + std::to_string(node) + "; the soft body has " +
                                                   std::to_string(body.positions.size()));
}

/// Adds a pin, or replaces the node's pin. The node moves to where it is held.
template <class Implementation>
void enter_pin(SoftBody& body, Implementation& world, SoftPin pin) {
  require_node(body, pin.node);
  if (!pin.in_place) {
    state::require_finite(pin.point, "point of a pin");
    flat::require_point(world.settings.plane, pin.point, "the point of a pin");
  }
  PinState state;
  Vec3& place = body.positions[pin.node];
  if (pin.body == BodyId{}) {
    if (pin.in_place) pin.point = place;
    place = pin.point;
    state.target = pin.point;
    body.velocities[pin.node] = Vec3(0, 0, 0);
  } else {
    const state::Body& holder = world.at(pin.body);
    const Pose& pose = holder.motion.pose;
    if (pin.in_place) pin.point = pose.rotation.conjugate() * (place - pose.position);
    state::require_finite(pin.point, "point of a pin");
    place = pose.position + pose.rotation * pin.point;
    body.velocities[pin.node] = velocity_at(holder.twist, place - holder.center);
    world.wake(pin.body.index);
  }
  pin.in_place = false;
  state.pin = pin;
  const auto found =
      std::ranges::lower_bound(body.pins, pin.node, {}, [](const PinState& other) { return other.pin.node; });
  if (found != body.pins.end() && found->pin.node == pin.node)
    *found = state;
  else
    body.pins.insert(found, state);
}

}  // namespace
}  // namespace soft

SoftNotFinite::SoftNotFinite(SoftId which, std::uint32_t node, double when)
    : NotFinite(NotFinite(BodyId{}, when, "what acts on its node " + std::to_string(node) + " throws it"),
                "soft body " + std::to_string(which.index) + " stopped being finite at " + number_text(when) +
                    " s: what acts on its node " + std::to_string(node) + " throws it"),
      soft(which) {}

SoftId add_soft(World& asked, const SoftSettings& settings) {
  auto& world = soft::Inside::changing(asked);
  soft::SoftBody body = soft::begun(soft::checked(settings));
  flat::require_soft(world.settings.plane, *body.made);
  for (const SoftPin& pin : settings.pins) soft::enter_pin(body, world, pin);
  if (world.unused_softs.empty()) {
    world.softs.push_back(std::move(body));
    return {static_cast<std::uint32_t>(world.softs.size() - 1), 0};
  }
  const std::uint32_t index = world.unused_softs.back();
  world.unused_softs.pop_back();
  body.generation = world.softs[index].generation;
  world.softs[index] = std::move(body);
  return {index, world.softs[index].generation};
}

void remove_soft(World& world, SoftId id) {
  soft::SoftBody& body = soft::changing(world, id);
  const std::uint32_t next = body.generation + 1;
  body = {};
  body.generation = next;
  soft::Inside::changing(world).unused_softs.push_back(id.index);
}

std::vector<SoftId> soft_bodies(const World& world) {
  const std::vector<soft::SoftBody>& all = soft::Inside::of(world).softs;
  std::vector<SoftId> ids;
  for (std::uint32_t i = 0; i < all.size(); ++i)
    if (all[i].alive) ids.push_back({i, all[i].generation});
  return ids;
}

std::span<const Vec3> soft_positions(const World& world, SoftId id) {
  return soft::at(world, id).positions;
}
std::span<const Vec3> soft_velocities(const World& world, SoftId id) {
  return soft::at(world, id).velocities;
}
const SoftSettings& soft_settings(const World& world, SoftId id) {
  return *soft::at(world, id).made;
}

bool torn(const World& world, SoftId id, std::size_t edge) {
  const soft::SoftBody& body = soft::at(world, id);
  state::require(edge < body.torn.size(), "there is no edge " + std::to_string(edge) + "; the soft body has " +
                                              std::to_string(body.torn.size()));
  return body.torn[edge] != 0;
}

std::span<const SoftTear> soft_tears(const World& world, SoftId id) {
  return soft::at(world, id).tears;
}

std::vector<std::array<std::uint32_t, 3>> soft_triangles(const World& world, SoftId id) {
  const soft::SoftBody& body = soft::at(world, id);
  std::vector<std::array<std::uint32_t, 3>> left;
  for (std::size_t i = 0; i < body.made->triangles.size(); ++i)
    if (body.gone.triangles[i] == 0) left.push_back(body.made->triangles[i]);
  return left;
}

SoftEnergy soft_energy(const World& world, SoftId id) {
  const soft::SoftBody& body = soft::at(world, id);
  const SoftSettings& made = *body.made;
  const std::vector<Vec3>& x = body.positions;
  const Vec3& gravity = soft::Inside::of(world).settings.gravity;
  SoftEnergy energy;
  for (std::size_t i = 0; i < x.size(); ++i) {
    energy.kinetic += 0.5 * made.masses[i] * body.velocities[i].squaredNorm();
    energy.weight -= made.masses[i] * gravity.dot(x[i]);
  }
  energy.elastic = soft::elastic_energy(body);
  return energy;
}

void apply_impulse(World& world, SoftId id, std::uint32_t node, const Vec3& impulse) {
  soft::SoftBody& body = soft::changing(world, id);
  soft::require_node(body, node);
  state::require_finite(impulse, "impulse");
  const Vec3 borne = flat::in_plane(soft::Inside::of(world).settings.plane, impulse);
  const Vec3 velocity = body.velocities[node] + borne / body.made->masses[node];
  state::require(state::countable(velocity), "the impulse would make the node faster than 1e30 m/s");
  if (!body.pin_of(node)) body.velocities[node] = velocity;
}

void pin(World& world, SoftId id, const SoftPin& pin) {
  soft::SoftBody& body = soft::changing(world, id);
  soft::enter_pin(body, soft::Inside::changing(world), pin);
}

void unpin(World& world, SoftId id, std::uint32_t node) {
  soft::SoftBody& body = soft::changing(world, id);
  soft::require_node(body, node);
  std::erase_if(body.pins, [node](const soft::PinState& state) { return state.pin.node == node; });
}

void lead_pin(World& world, SoftId id, std::uint32_t node, const Vec3& point, const Vec3& velocity) {
  soft::SoftBody& body = soft::changing(world, id);
  soft::PinState* const state = body.pin_of(node);
  state::require(state && state->pin.body == BodyId{},
                 "node " + std::to_string(node) + " is not pinned to the world: there is nothing to lead");
  state::require_finite(point, "point of a pin");
  state::require_finite(velocity, "velocity of a pin");
  const WorldPlane plane = soft::Inside::of(world).settings.plane;
  flat::require_point(plane, point, "the point of a pin");
  flat::require_point(plane, velocity, "the velocity of a pin");
  state->pin.point = state->target = point;
  state->velocity = velocity;
}

std::vector<SoftPinReading> soft_pins(const World& world, SoftId id) {
  std::vector<SoftPinReading> readings;
  for (const soft::PinState& state : soft::at(world, id).pins) readings.push_back({state.pin, state.force});
  return readings;
}

}  // namespace tweenfall
