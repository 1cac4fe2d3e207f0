#include "forces/kinds/kinds.h"
#include "state/checks.h"

namespace tweenfall::forces {

double resistance_of(const Drag& drag, double speed) {
  return drag.linear + drag.quadratic * speed;
}

Effect effect_of(const Drag& kind, double strength, const Subject& subject, const Moment&) {
  const double share = not_negative(strength);
  Effect effect;
  effect.resistance = share * resistance_of(kind, subject.at.linear.norm());
  effect.angular_resistance = share * kind.angular;
  return effect;
}

void validate(const Drag& kind) {
  state::require_amount(kind.linear, "linear drag");
  state::require_amount(kind.quadratic, "quadratic drag");
  state::require_amount(kind.angular, "angular drag");
}

}  // namespace tweenfall::forces
