#include "forces/kinds/kinds.h"
#include "state/checks.h"

namespace tweenfall::forces {

Effect effect_of(const Vortex& kind, double strength, const Subject& subject, const Moment&) {
  const Vec3 axis = kind.axis / kind.axis.norm();
  const Vec3 from = subject.at.center - kind.at;
  const Vec3 out = from - axis.dot(from) * axis;
  const double fall = fall_off(out.squaredNorm() + kind.softening * kind.softening, kind.power);
  Effect effect;
  effect.force = strength * kind.acceleration * subject.body.mass().mass * fall * (axis.cross(out) - kind.inward * out);
  return effect;
}

void validate(const Vortex& kind) {
  state::require_finite(kind.at, "place of a vortex");
  state::require_finite(kind.axis, "axis of a vortex");
  state::require(kind.axis.norm() >= state::smallest, "the axis of a vortex must not be zero");
  state::require(state::countable(kind.acceleration), "acceleration of a vortex must be finite and at most 1e30");
  state::require(state::countable(kind.inward), "inward part of a vortex must be finite and at most 1e30");
  require_power(kind.power, "a vortex");
  state::require_amount(kind.softening, "softening of a vortex");
}

}  // namespace tweenfall::forces
