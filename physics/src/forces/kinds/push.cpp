#include "forces/kinds/kinds.h"
#include "state/checks.h"

namespace tweenfall::forces {

namespace {

Vec3 arm_of(const Push& kind, const Subject& subject) {
  return kind.at ? Vec3(subject.at.rotation * (*kind.at - subject.body.mass().center)) : Vec3(0, 0, 0);
}

}  // namespace

Effect effect_of(const Push& kind, double strength, const Subject& subject, const Moment&) {
  const auto in_world = [&](const Vec3& given) { return kind.turns ? Vec3(subject.at.rotation * given) : Vec3(given); };
  Effect effect;
  effect.force = strength * in_world(kind.force);
  effect.torque = strength * in_world(kind.torque) + arm_of(kind, subject).cross(effect.force);
  return effect;
}

std::optional<double> energy_of(const Push& kind, double strength, const Subject& subject, const Moment&) {
  if (kind.turns || kind.torque != Vec3::Zero()) return std::nullopt;
  return -strength * kind.force.dot(subject.at.center + arm_of(kind, subject));
}

void validate(const Push& kind) {
  state::require_finite(kind.force, "force of a push");
  state::require_finite(kind.torque, "torque of a push");
  if (kind.at) state::require_finite(*kind.at, "place of a push");
}

}  // namespace tweenfall::forces
