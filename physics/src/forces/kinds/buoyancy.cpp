#include "forces/kinds/kinds.h"
#include "shapes/submerged.h"
#include "state/checks.h"

namespace tweenfall::forces {

namespace {

struct Afloat {
  Vec3 normal;
  double level;
  shapes::Submerged part;
  Vec3 arm;  ///< from the center of mass to the center of the submerged part, world axes
};

Afloat afloat(const Buoyancy& kind, const Subject& subject) {
  Afloat result;
  const double length = kind.normal.norm();
  result.normal = kind.normal / length;
  result.level = kind.level;
  const Quat inverse = subject.at.rotation.conjugate();
  const Vec3 own = inverse * result.normal;
  const Vec3& center = subject.body.mass().center;
  // In the node's own axes, in which the solid is given.
  const double level = kind.level - result.normal.dot(subject.at.center) + own.dot(center);
  result.part = shapes::submerged(subject.body.shape(), own, level);
  result.arm = subject.at.rotation * (result.part.center - center);
  return result;
}

}  // namespace

Effect effect_of(const Buoyancy& kind, double strength, const Subject& subject, const Moment& moment) {
  const double share = not_negative(strength);
  const Afloat at = afloat(kind, subject);
  Effect effect;
  if (!(at.part.volume > 0) || share == 0) return effect;
  effect.force = -share * kind.density * at.part.volume * moment.gravity;
  effect.torque = at.arm.cross(effect.force);
  const double under = share * at.part.share;
  effect.resistance = under * resistance_of(kind.drag, (subject.at.linear - kind.flow).norm());
  effect.angular_resistance = under * kind.drag.angular;
  effect.medium = kind.flow;
  return effect;
}

std::optional<double> energy_of(const Buoyancy& kind, double strength, const Subject& subject, const Moment& moment) {
  const Afloat at = afloat(kind, subject);
  const double pull = -at.normal.dot(moment.gravity);
  // If gravity also has a part along the surface, the force has a curl there.
  if ((moment.gravity + pull * at.normal).norm() > 1e-12 * moment.gravity.norm()) return std::nullopt;
  const double depth = at.level - at.normal.dot(subject.at.center + at.arm);
  return at.part.volume > 0 ? not_negative(strength) * kind.density * at.part.volume * pull * depth : 0;
}

void validate(const Buoyancy& kind) {
  state::require_finite(kind.normal, "normal of a liquid's surface");
  state::require(kind.normal.norm() >= state::smallest, "the normal of a liquid's surface must not be zero");
  state::require(state::countable(kind.level), "the level of a liquid must be finite and at most 1e30");
  state::require_amount(kind.density, "density of a liquid");
  state::require_finite(kind.flow, "flow of a liquid");
  validate(kind.drag);
}

}  // namespace tweenfall::forces
