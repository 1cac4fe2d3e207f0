#include <tweenfall/curves/number_text.h>

#include <cmath>

#include "state/countable.h"
#include "state/world_data.h"

namespace tweenfall {

namespace step {
namespace {

/// What most likely threw a body: the greatest of its earlier motion and of what acted on it.
std::string cause_of(const Twist& before, const forces::Load& load, bool touched, double dt) {
  const double speed = before.linear.norm(), spin = before.angular.norm();
  const double gain = load.acceleration.norm() * dt, torque = load.torque.norm();
  if (gain > 1e6 && gain > speed) return "forces accelerate it by " + number_text(load.acceleration.norm()) + " m/s^2";
  if (torque > 1e6) return "torques of " + number_text(torque) + " N m turn it";
  if (speed > 1e6) return "it already moved at " + number_text(speed) + " m/s in the step before";
  if (spin > 1e6) return "it already turned at " + number_text(spin) + " rad/s in the step before";
  return touched ? "its contacts, springs or joints throw it"
                 : "the step of " + number_text(dt) + " s is too long for what acts on it";
}

}  // namespace
}  // namespace step

NotFinite::NotFinite(BodyId which, double when, const std::string& why)
    : std::runtime_error("body " + std::to_string(which.index) + " stopped being finite at " + number_text(when) +
                         " s: " + why),
      body(which),
      time(when),
      cause(why) {}

NotFinite::NotFinite(const NotFinite& fault, const std::string& text)
    : std::runtime_error(text), body(fault.body), time(fault.time), cause(fault.cause) {}

void World::Implementation::check_bodies(double dt, double at) const {
  for (const std::uint32_t i : watched) {
    if (bodies[i].finite()) continue;
    // If no step was made, the body was left like this.
    const std::string cause = i < starts.size() && dt > 0 ? step::cause_of(starts[i].twist, loads[i], moved[i] != 0, dt)
                                                          : "it was not finite before the step";
    throw NotFinite({i, bodies[i].generation}, at, cause);
  }
}

void World::Implementation::check_loads(double at) const {
  for (const std::uint32_t i : watched) {
    const forces::Load& load = loads[i];
    if (state::countable(load.acceleration) && state::countable(load.end_acceleration) &&
        state::countable(load.torque) && std::isfinite(load.drag))
      continue;
    throw NotFinite({i, bodies[i].generation}, at,
                    "a spring, a field or a force accelerates it by more than 1e30 m/s^2");
  }
}

}  // namespace tweenfall
