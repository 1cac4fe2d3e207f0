#include "stage/actors/energy.h"

#include <stdexcept>

namespace tweenfall::staging {

namespace {

StageEnergy energy_of(const StageState& state) {
  StageEnergy energy{.kinetic = state.world.kinetic_energy(), .weight = state.world.potential_energy(), .forces = {}};
  for (const std::size_t number : state.forces) {
    std::optional<double>& one = energy.forces.emplace_back();
    try {
      one = state.world.potential_energy(number);
    } catch (const std::invalid_argument&) {
      continue;  // it was removed with its body
    }
    energy.weight -= one.value_or(0);
  }
  return energy;
}

}  // namespace

StageEnergy stage_energy(const StageState& from, const StageState& to, double time) {
  StageEnergy energy = energy_of(to);
  if (&from == &to || !(time < to.time)) return energy;
  const StageEnergy before = energy_of(from);
  const double part = (time - from.time) / (to.time - from.time);
  const auto mix = [part](double first, double last) { return first + part * (last - first); };
  energy.kinetic = mix(before.kinetic, energy.kinetic);
  energy.weight = mix(before.weight, energy.weight);
  for (std::size_t i = 0; i < energy.forces.size() && i < before.forces.size(); ++i)
    if (energy.forces[i] && before.forces[i]) energy.forces[i] = mix(*before.forces[i], *energy.forces[i]);
  return energy;
}

}  // namespace tweenfall::staging
