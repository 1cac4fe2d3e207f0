#include "forces/kinds/kinds.h"
#include "state/checks.h"

namespace tweenfall::forces {

Effect effect_of(const Field& kind, double strength, const Subject& subject, const Moment& moment) {
  Effect effect;
  effect.force = kind(subject.body.mass().mass, subject.at.center, subject.at.linear, moment.time);
  if (strength != 1) effect.force *= strength;
  return effect;
}

void validate(const Field& kind) {
  state::require(static_cast<bool>(kind), "a field must hold a function");
}

}  // namespace tweenfall::forces
