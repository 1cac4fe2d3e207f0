#include <stdexcept>
#include <string>

#include "forces/forces.h"
#include "state/checks.h"
#include "state/world_data.h"

namespace tweenfall {

namespace forces {
namespace {

/// The bodies as they are.
class Present : public Moment {
 public:
  using Moment::Moment;
  [[nodiscard]] Glimpse of(std::uint32_t body) const override { return now(bodies[body]); }
};

NumberedForce& entry_of(std::vector<NumberedForce>& forces, std::size_t number) {
  for (NumberedForce& entry : forces)
    if (entry.number == number) return entry;
  throw std::invalid_argument("there is no force number " + std::to_string(number));
}

std::vector<std::uint32_t> bodies_there(const std::vector<state::Body>& bodies) {
  std::vector<std::uint32_t> there;
  for (std::uint32_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].alive) there.push_back(i);
  return there;
}

std::optional<double> energy_in(const NumberedForce& entry, const Moment& moment,
                                const std::vector<std::uint32_t>& all) {
  const double strength = entry.settings.strength.at(moment.time);
  if (std::holds_alternative<Spring>(entry.force)) {
    const std::optional<Spring> spring = spring_between(entry.force, strength, moment.bodies);
    return spring ? energy_of(*spring, moment) : 0;
  }
  const auto of_bodies = [&](const auto& kind) -> std::optional<double> {
    double sum = 0;
    bool any = false, none = false;
    each_acted(entry, moment.bodies, all, [&](std::uint32_t i) {
      if (moment.bodies[i].immovable()) return;
      const std::optional<double> one = energy_of(kind, strength, Subject{moment.bodies[i], moment.of(i)}, moment);
      any = any || one;
      none = none || !one;
      sum += one.value_or(0);
    });
    return any && !none ? std::optional(sum) : std::nullopt;
  };
  return std::visit(of_bodies, entry.force);
}

}  // namespace
}  // namespace forces

std::size_t World::add_force(Force force, ForceSettings settings) {
  Implementation& world = changing();
  state::validate(force);
  const forces::Named named = forces::named(force);
  for (std::size_t i = 0; i < named.ends.size(); ++i)
    if (named.ends[i] != BodyId{} || (named.alone && i == 0)) static_cast<void>(world.at(named.ends[i]));
  for (const BodyId& body : settings.bodies) static_cast<void>(world.at(body));
  state::require(!named.alone || settings.bodies.empty(), "this kind of force names its bodies itself");
  const auto number = static_cast<std::size_t>(world.next_force++);
  world.forces.push_back({number, std::move(force), std::move(settings)});
  forces::each_acted(world.forces.back(), world.bodies, forces::bodies_there(world.bodies),
                     [&](std::uint32_t i) { world.wake(i); });
  return number;
}

void World::remove_force(std::size_t number) {
  Implementation& world = changing();
  static_cast<void>(forces::entry_of(world.forces, number));
  std::erase_if(world.forces, [&](const forces::NumberedForce& f) { return f.number == number; });
  for (const std::uint32_t i : forces::bodies_there(world.bodies)) world.wake(i);
}

void World::set_strength(std::size_t number, const Strength& strength) {
  Implementation& world = changing();
  forces::NumberedForce& entry = forces::entry_of(world.forces, number);
  if (entry.settings.strength == strength) return;
  entry.settings.strength = strength;
  forces::each_acted(entry, world.bodies, forces::bodies_there(world.bodies), [&](std::uint32_t i) { world.wake(i); });
}

std::optional<double> World::potential_energy(std::size_t number) const {
  const Implementation& world = inside();
  const forces::Present moment(world.bodies, world.settings.gravity, world.time);
  for (const forces::NumberedForce& entry : world.forces)
    if (entry.number == number) return forces::energy_in(entry, moment, forces::bodies_there(world.bodies));
  throw std::invalid_argument("there is no force number " + std::to_string(number));
}

double World::potential_energy() const {
  const Implementation& world = inside();
  const forces::Present moment(world.bodies, world.settings.gravity, world.time);
  const std::vector<std::uint32_t> all = forces::bodies_there(world.bodies);
  double sum = 0;
  for (const std::uint32_t i : all)
    if (const state::Body& body = world.bodies[i]; !body.immovable())
      sum -= body.mass().mass * world.settings.gravity.dot(body.center);
  for (const forces::NumberedForce& entry : world.forces) sum += forces::energy_in(entry, moment, all).value_or(0);
  return sum;
}

void World::Implementation::wake_by_forces(double dt) {
  for (const forces::NumberedForce& entry : forces)
    if (forces::stirs(entry, time, time + dt))
      forces::each_acted(entry, bodies, watched, [this](std::uint32_t i) { wake(i); });
}

void World::Implementation::wake_forced(BodyId id) {
  for (const forces::NumberedForce& entry : forces) {
    const forces::Named named = forces::named(entry.force);
    if (named.ends[0] != id && named.ends[1] != id) continue;
    forces::each_acted(entry, bodies, forces::bodies_there(bodies), [this](std::uint32_t i) { wake(i); });
  }
}

}  // namespace tweenfall
