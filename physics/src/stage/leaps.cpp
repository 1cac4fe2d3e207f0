#include "stage/leaps.h"

#include <algorithm>

namespace tweenfall::staging {

namespace {

void add_leaps(const Strength& strength, std::vector<double>& out) {
  if (!strength.curve()) return;
  for (const double knot : strength.curve()->knots())
    if (strength.at(knot, Side::in) != strength.at(knot, Side::out)) out.push_back(knot);
}

}  // namespace

std::shared_ptr<const std::vector<double>> leaps_of(const StageDescription& description) {
  std::vector<double> leaps;
  for (const ForceDescription& force : description.forces) add_leaps(force.strength, leaps);
  for (const ParticlesDescription& particles : description.particles)
    for (const ForceDescription& force : particles.forces) add_leaps(force.strength, leaps);
  for (const VehicleDescription& vehicle : description.vehicles)
    for (const Strength* const script : {&vehicle.throttle, &vehicle.brake, &vehicle.steer}) add_leaps(*script, leaps);
  std::ranges::sort(leaps);
  leaps.erase(std::unique(leaps.begin(), leaps.end()), leaps.end());
  return std::make_shared<const std::vector<double>>(std::move(leaps));
}

double next_leap(const StageState& state, double from, double to) {
  const auto next = std::ranges::upper_bound(*state.leaps, from);
  return next != state.leaps->end() && *next <= to ? *next : infinity;
}

}  // namespace tweenfall::staging
