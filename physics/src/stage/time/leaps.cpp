#include "stage/time/leaps.h"

#include <algorithm>

#include "forces/formula_leaps.h"

namespace tweenfall::staging {

namespace {

void add_leaps(const Strength& strength, Leaps& out) {
  out.formulas.insert(out.formulas.end(), strength.leaping_parts().begin(), strength.leaping_parts().end());
  if (!strength.curve()) return;
  for (const double knot : strength.curve()->knots())
    if (strength.at(knot, Side::in) != strength.at(knot, Side::out)) out.keyed.push_back(knot);
}

void add_leaps(const ForceDescription& force, Leaps& out) {
  add_leaps(force.strength, out);
  if (const auto* field = std::get_if<ForceFormula>(&force.force)) out.fields.push_back(*field);
}

}  // namespace

std::shared_ptr<const Leaps> leaps_of(const StageDescription& description) {
  Leaps leaps;
  for (const ForceDescription& force : description.forces) add_leaps(force, leaps);
  for (const ParticlesDescription& particles : description.particles)
    for (const ForceDescription& force : particles.forces) add_leaps(force, leaps);
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
    first = std::min(first, forces::next_leap(forces::by_time(formula, 0), from, std::min(to, first)));
  for (const ForceFormula& field : state.leaps->fields)
    first = std::min(first, field.next_leap(from, std::min(to, first)));
  return first;
}

}  // namespace tweenfall::staging
