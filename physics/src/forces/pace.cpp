#include "forces/pace.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tweenfall::forces {

namespace {

class Asked {
 public:
  Asked(const NumberedForce& force, const state::Body& body, const Moment& moment, bool resistance)
      : force_(force),
        body_(body),
        moment_(moment),
        strength_(force.settings.strength.at(moment.time)),
        resistance_(resistance) {}

  [[nodiscard]] Effect effect(const Vec3& center, const Vec3& linear) const {
    return effect_of(force_.force, strength_,
                     {body_, {center, linear, body_.twist.angular, body_.motion.pose.rotation}}, moment_);
  }
  [[nodiscard]] Vec3 acceleration(const Vec3& center, const Vec3& linear) const {
    const Effect at = effect(center, linear);
    const Vec3 resisted = resistance_ ? Vec3(at.resistance * (linear - at.medium)) : Vec3(Vec3::Zero());
    return (at.force - resisted) / body_.mass().mass;
  }

 private:
  const NumberedForce& force_;
  const state::Body& body_;
  const Moment& moment_;
  double strength_;
  bool resistance_;
};

/// The greatest column of the derivative of `of`, from a small change along each axis.
template <class Of>
double steepest(double change, const Of& of) {
  double most = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 along = change * Vec3::Unit(axis);
    most = std::max(most, (of(along) - of(Vec3(-along))).norm() / (2 * change));
  }
  return most;
}

}  // namespace

Pace pace_of(const NumberedForce& force, const state::Body& body, const Vec3& linear, const Moment& moment,
             bool resistance) {
  constexpr double small = 1e-4;  // relative to the value
  const Asked asked(force, body, moment, resistance);
  Pace pace;
  pace.damping = steepest(small * std::max(1.0, linear.norm()),
                          [&](const Vec3& more) { return asked.acceleration(body.center, linear + more); });
  pace.swing = std::sqrt(steepest(small * body.radius(),
                                  [&](const Vec3& aside) { return asked.acceleration(body.center + aside, linear); }));
  if (resistance)
    pace.damping = std::max(pace.damping, asked.effect(body.center, linear).angular_resistance *
                                              body.inverse_inertia().diagonal().maxCoeff());
  return pace;
}

double falling_speed(const NumberedForce& force, const state::Body& body, const Moment& moment) {
  const double weight = moment.gravity.norm();
  if (!(weight > 0)) return std::numeric_limits<double>::infinity();
  const Vec3 down = moment.gravity / weight;
  const Asked asked(force, body, moment, true);
  const Vec3 resting = asked.acceleration(body.center, Vec3::Zero());
  const auto borne = [&](double speed) {
    return (resting - asked.acceleration(body.center, Vec3(speed * down))).dot(down) >= weight;
  };
  double low = 0, high = 1e6;
  if (!borne(high)) return std::numeric_limits<double>::infinity();
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = 0.5 * (low + high);
    (borne(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace tweenfall::forces
