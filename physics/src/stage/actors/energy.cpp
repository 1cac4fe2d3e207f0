#include "stage/actors/energy.h"

#include <stdexcept>

#include "stage/between.h"
#include "stage/roster/staged_softs.h"

namespace tweenfall {

namespace staging {
namespace {

ParticlesEnergy energy_of(const Particles& particles) {
  Vec3 places(0, 0, 0);
  for (std::size_t i = 0; i < particles.size(); ++i) places += particles.position(i);
  const ParticleSettings& settings = particles.settings();
  return {.kinetic = particles.kinetic_energy(), .weight = 0 - settings.mass * settings.gravity.dot(places)};
}

StageEnergy energy_of(const StageState& state) {
  StageEnergy energy;
  energy.kinetic = state.world.kinetic_energy();
  energy.weight = state.world.potential_energy();
  for (const std::size_t number : state.forces) {
    std::optional<double>& one = energy.forces.emplace_back();
    try {
      one = state.world.potential_energy(number);
    } catch (const std::invalid_argument&) {
      continue;  // it was removed with its body
    }
    energy.weight -= one.value_or(0);
  }
  for (const auto& [name, id] : state.softs->list) energy.softs.push_back(soft_energy(state.world, id));
  for (const StagedParticles& staged : state.particles) energy.particles.push_back(energy_of(staged.particles));
  return energy;
}

}  // namespace

StageEnergy stage_energy(const StageState& from, const StageState& to, double time) {
  StageEnergy energy = energy_of(to);
  if (!is_between(from, to, time)) return energy;
  const StageEnergy before = energy_of(from);
  const double part = (time - from.time) / (to.time - from.time);
  const auto mix = [part](double first, double last) { return first + part * (last - first); };
  energy.kinetic = mix(before.kinetic, energy.kinetic);
  energy.weight = mix(before.weight, energy.weight);
  for (std::size_t i = 0; i < energy.forces.size() && i < before.forces.size(); ++i)
    if (energy.forces[i] && before.forces[i]) energy.forces[i] = mix(*before.forces[i], *energy.forces[i]);
  for (std::size_t i = 0; i < energy.softs.size(); ++i)
    for (double SoftEnergy::*kind : {&SoftEnergy::kinetic, &SoftEnergy::elastic, &SoftEnergy::weight})
      energy.softs[i].*kind = mix(before.softs[i].*kind, energy.softs[i].*kind);
  for (std::size_t i = 0; i < energy.particles.size(); ++i)
    for (double ParticlesEnergy::*kind : {&ParticlesEnergy::kinetic, &ParticlesEnergy::weight})
      energy.particles[i].*kind = mix(before.particles[i].*kind, energy.particles[i].*kind);
  return energy;
}

}  // namespace staging

double StageEnergy::total() const {
  double sum = kinetic + weight;
  for (const std::optional<double>& force : forces) sum += force.value_or(0);
  for (const SoftEnergy& soft : softs) sum += soft.kinetic + soft.elastic + soft.weight;
  for (const ParticlesEnergy& one : particles) sum += one.kinetic + one.weight;
  return sum;
}

}  // namespace tweenfall
