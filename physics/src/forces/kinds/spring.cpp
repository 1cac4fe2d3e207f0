#include <cmath>

#include "forces/forces.h"
#include "forces/kinds/kinds.h"
#include "state/checks.h"

namespace tweenfall::forces {

Spring spring_of(const Spring& kind, double strength) {
  if (strength == 1) return kind;
  Spring spring = kind;
  spring.stiffness *= not_negative(strength);
  spring.damping *= not_negative(strength);
  return spring;
}

double energy_of(const Spring& spring, const Moment& moment) {
  const state::Body* a = find_body(moment.bodies, spring.a);
  const state::Body* b = find_body(moment.bodies, spring.b);
  if (!a || (!b && spring.b != BodyId{})) return 0;
  const Glimpse at_a = moment.of(spring.a.index), at_b = b ? moment.of(spring.b.index) : Glimpse{};
  const Vec3 end_a = at_a.center + at_a.rotation * (spring.anchor_a - a->mass().center);
  const Vec3 end_b =
      b ? Vec3(at_b.center + at_b.rotation * (spring.anchor_b - b->mass().center)) : Vec3(spring.anchor_b);
  const double stretch = (end_b - end_a).norm() - spring.rest_length;
  return 0.5 * spring.stiffness * stretch * stretch;
}

void validate(const Spring& kind) {
  state::require_finite(kind.anchor_a, "first anchor of a spring");
  state::require_finite(kind.anchor_b, "second anchor of a spring");
  state::require_amount(kind.rest_length, "rest length of a spring");
  state::require_amount(kind.stiffness, "stiffness of a spring");
  state::require_amount(kind.damping, "damping of a spring");
}

}  // namespace tweenfall::forces
