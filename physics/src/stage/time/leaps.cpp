#include "stage/time/leaps.h"

#include <algorithm>

#include "forces/formula_leaps.h"

namespace tweenfall::staging {

namespace {

void add_leaps(const Strength& strength, Leaps& out) {
  if (forces::may_leap(strength.text())) out.formulas.emplace_back(strength.text());
  if (!strength.curve()) return;
  for (const double knot : strength.curve()->knots())
    if (strength.at(knot, Side::in) != strength.at(knot, Side::out)) out.keyed.push_back(knot);
}

}  // namespace

std::shared_ptr<const Leaps> leaps_of(const StageDescription& description) {
  Leaps leaps;
  for (const ForceDescription& force : description.forces) add_leaps(force.strength, leaps);
  for (const ParticlesDescription& particles : description.particles)
    for (const ForceDescription& force : particles.forces) add_leaps(force.strength, leaps);
  for (const VehicleDescription& vehicle : description.vehicles)
    for (const Strength* const script : {&vehicle.throttle, &vehicle.brake, &vehicle.steer}) add_leaps(*script, leaps);
  std::ranges::sort(leaps.keyed);
  leaps.keyed.erase(std::unique(leaps.keyed.begin(), leaps.keyed.end()), leaps.keyed.end());
  return std::make_shared<const Leaps>(std::move(leaps));
}

double next_leap(const StageState& state, double from, double to) {
  const std::vector<double>& keyed = state.leaps->keyed;
  const auto next = std::ranges::upper_bound(keyed, from);
  double first = next != keyed.end() && *next <= to ? *next : infinity;
  for (const Expression& formula : state.leaps->formulas)
    first = std::min(first, forces::next_leap(formula, from, std::min(to, first)));
  return first;
}

}  // namespace tweenfall::staging
