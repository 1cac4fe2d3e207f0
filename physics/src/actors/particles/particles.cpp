#include <tweenfall/physics/particles.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "actors/particles/block.h"
#include "actors/particles/colliders.h"
#include "forces/integrators/integrators.h"
#include "state/checks.h"

namespace tweenfall {

namespace particles {
namespace {

void validate(const ParticleSettings& settings) {
  state::require_finite(settings.gravity, "gravity");
  state::require(forces::exists(settings.integrator), "there is no such integrator");
  state::require(settings.mass >= state::smallest && settings.mass <= state::largest,
                 "mass of a particle must lie in 1e-30 kg to 1e30 kg");
  state::require_amount(settings.radius, "radius of a particle");
  state::require(settings.restitution >= 0 && settings.restitution <= 1, "restitution must lie in 0 to 1");
  state::require_amount(settings.friction, "friction");
  state::require(settings.life > 0, "life of a particle must be positive");
  state::require(settings.life_spread >= 0 && settings.life_spread <= 1, "spread of lives must lie in 0 to 1");
}

}  // namespace
}  // namespace particles

Particles::Particles(const ParticleSettings& settings) : settings_(settings) {
  particles::validate(settings);
}

void Particles::add_force(const Force& force, const Strength& strength) {
  state::validate(force);
  state::require(particles::acts_on_particles(force),
                 "only drag, winds, vortices, formulas, fields, and attractors of the world act on particles");
  forces_.push_back({force, strength});
}

void Particles::step(double dt) {
  advance(dt, nullptr);
}

void Particles::step(double dt, const World& world) {
  advance(dt, &world);
}

void Particles::advance(double dt, const World* world) {
  // Not by a check that makes its words in any case: a step takes no memory.
  if (!(dt > 0 && std::isfinite(dt))) throw std::invalid_argument("a step must be positive and finite");
  std::optional<particles::Colliders> colliders;
  if (world) colliders.emplace(*world, dt, settings_.radius, settings_.restitution, settings_.friction);
  const particles::Colliders* among = colliders && !colliders->empty() ? &*colliders : nullptr;
  move(0, size(), time_, dt, among);
  let_go(time_ + dt, among);
  time_ += dt;
  bury();
}

void Particles::move(std::size_t first, std::size_t behind, double from, double dt,
                     const particles::Colliders* colliders) {
  using particles::most_together;
  // A few need no memory of their own.
  std::array<particles::PullingForce, 8> few;
  std::vector<particles::PullingForce> many(forces_.size() > few.size() ? forces_.size() : 0);
  const std::span<particles::PullingForce> forces =
      many.empty() ? std::span(few).first(forces_.size()) : std::span(many);
  particles::Pulling pulling{settings_.gravity, settings_.mass, settings_.radius, {}, true};
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    const Acting& acting = forces_[i];
    const Strength& strength = acting.strength;
    forces[i] = {&acting.force, strength.at(from), strength.at(from + 0.5 * dt), strength.at(from + dt, Side::in)};
    pulling.steady = pulling.steady && particles::is_steady(acting.force) && !strength.changes(from, from + dt);
  }
  pulling.forces = forces;
  particles::Lists places, speeds, before, with;
  const std::array<std::vector<double>*, 3> all_places{&x_, &y_, &z_}, all_speeds{&vx_, &vy_, &vz_};
  for (std::size_t begin = first; begin < behind; begin += most_together) {
    const std::size_t count = std::min(most_together, behind - begin);
    const auto at = static_cast<std::ptrdiff_t>(begin);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::copy_n(all_places[axis]->begin() + at, count, places[axis].begin());
      std::copy_n(all_speeds[axis]->begin() + at, count, speeds[axis].begin());
      if (!colliders) continue;
      std::copy_n(places[axis].begin(), count, before[axis].begin());
      std::copy_n(speeds[axis].begin(), count, with[axis].begin());
    }
    particles::integrate(settings_.integrator, pulling, count, from, dt, places, speeds);
    if (colliders) colliders->turn_back(count, dt, before, with, places, speeds);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::copy_n(places[axis].begin(), count, all_places[axis]->begin() + at);
      std::copy_n(speeds[axis].begin(), count, all_speeds[axis]->begin() + at);
    }
  }
}

void Particles::bury() {
  const auto is_over = [this](std::size_t i) {
    return dies_[i] <= time_ || !state::countable(position(i)) || !state::countable(velocity(i));
  };
  bool any = false;
  for (std::size_t i = 0; i < size() && !any; ++i) any = is_over(i);
  if (!any) return;
  const std::array<std::vector<double>*, 8> numbers{&x_, &y_, &z_, &vx_, &vy_, &vz_, &born_, &dies_};
  std::size_t kept = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    if (is_over(i)) continue;
    if (kept != i) {
      for (std::vector<double>* list : numbers) (*list)[kept] = (*list)[i];
      number_[kept] = number_[i];
    }
    ++kept;
  }
  for (std::vector<double>* list : numbers) list->resize(kept);
  number_.resize(kept);
}

double Particles::kinetic_energy() const noexcept {
  double sum = 0;
  for (std::size_t i = 0; i < size(); ++i) sum += velocity(i).squaredNorm();
  return 0.5 * settings_.mass * sum;
}

Vec3 Particles::momentum() const noexcept {
  Vec3 sum(0, 0, 0);
  for (std::size_t i = 0; i < size(); ++i) sum += velocity(i);
  return settings_.mass * sum;
}

}  // namespace tweenfall
