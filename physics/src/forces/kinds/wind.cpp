#include "forces/kinds/kinds.h"
#include "shapes/shadow.h"
#include "state/checks.h"

namespace tweenfall::forces {

Effect effect_of(const Wind& kind, double strength, const Subject& subject, const Moment&) {
  const double share = not_negative(strength);
  const Vec3 against = subject.at.linear - kind.velocity;
  const double speed = against.norm();
  Effect effect;
  double quadratic = kind.quadratic;
  if (kind.coefficient > 0 && speed > 0)
    quadratic += 0.5 * kind.density * kind.coefficient *
                 shapes::shadow_of(subject.body.shape(), subject.at.rotation.conjugate() * Vec3(against / speed));
  effect.resistance = share * resistance_of({kind.linear, quadratic, 0}, speed);
  effect.angular_resistance = share * kind.angular;
  effect.medium = kind.velocity;
  return effect;
}

void validate(const Wind& kind) {
  state::require_finite(kind.velocity, "velocity of a wind");
  state::require_amount(kind.linear, "linear drag of a wind");
  state::require_amount(kind.quadratic, "quadratic drag of a wind");
  state::require_amount(kind.angular, "angular drag of a wind");
  state::require_amount(kind.coefficient, "drag coefficient of a wind");
  state::require_amount(kind.density, "density of a wind");
}

}  // namespace tweenfall::forces
