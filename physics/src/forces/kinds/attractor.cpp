#include <tweenfall/curves/elementary.h>

#include <cmath>

#include "forces/forces.h"
#include "forces/kinds/kinds.h"
#include "state/checks.h"

namespace tweenfall::forces {

namespace {

/// From the body to the attracting point; empty if that was on a body that was removed.
std::optional<Vec3> way_to(const Attractor& kind, const Subject& subject, const Moment& moment) {
  if (kind.of == BodyId{}) return Vec3(kind.at - subject.at.center);
  const state::Body* source = find_body(moment.bodies, kind.of);
  if (!source) return std::nullopt;
  const Glimpse at = moment.of(kind.of.index);
  return Vec3(at.center + at.rotation * (kind.at - source->mass().center) - subject.at.center);
}

double amount(const Attractor& kind, double strength, const Subject& subject) {
  return strength * kind.acceleration * (kind.by_mass ? subject.body.mass().mass : 1);
}

}  // namespace

Effect effect_of(const Attractor& kind, double strength, const Subject& subject, const Moment& moment) {
  Effect effect;
  const std::optional<Vec3> way = way_to(kind, subject, moment);
  if (!way) return effect;
  const double square = way->squaredNorm() + kind.softening * kind.softening;
  effect.force = amount(kind, strength, subject) * fall_off(square, kind.power) * *way;
  return effect;
}

std::optional<double> energy_of(const Attractor& kind, double strength, const Subject& subject, const Moment& moment) {
  const std::optional<Vec3> way = way_to(kind, subject, moment);
  if (!way) return 0;
  const double square = way->squaredNorm() + kind.softening * kind.softening;
  const double of_all = amount(kind, strength, subject);
  // For a power of 1 the energy is 0 at 1 m, otherwise at infinity or at the point.
  if (kind.power == 1) return square > 0 ? of_all * 0.5 * elementary::log(square) : 0;
  return of_all * fall_off(square, kind.power - 2) / (1 - kind.power);
}

void validate(const Attractor& kind) {
  state::require_finite(kind.at, "place of an attractor");
  state::require(state::countable(kind.acceleration), "acceleration of an attractor must be finite and at most 1e30");
  require_power(kind.power, "an attractor");
  state::require_amount(kind.softening, "softening of an attractor");
}

}  // namespace tweenfall::forces
