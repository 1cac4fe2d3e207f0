#include <algorithm>
#include <cmath>

#include "step/solver.h"

/// Between two that are led against each other no push is enough.

namespace tweenfall::step {

namespace {

/// Part of the speed of what presses with which a contact still closes that nothing could satisfy.
constexpr double unsatisfied = 0.5;

/// What presses a body from where it does not give way.
struct Squeeze {
  std::uint32_t first = not_led;  ///< who presses
  bool by_several = false;
  double speed = 0;    ///< of what presses, where it does, m/s
  double closing = 0;  ///< that the passes left, m/s
  double reach = 0;    ///< farthest that it is pressed from its center, m
  SolvedContact* hardest = nullptr;
  double impulse = 0;  ///< of the hardest contact, N s
};

}  // namespace

/// What is pinched leaves no faster than what pinches it comes, or than it was before, and its contacts forget what
/// they asked for; else their pushes would grow from sub-step to sub-step, and with them what rubs and turns.
void Solver::tame_pinched() {
  if (led_.empty()) return;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    SolverBody& body = bodies_[i];
    if (!body.movable || body.pulled) continue;
    Squeeze squeeze;
    const auto own = [&](const SolvedContact& contact) {
      return (contact.a == body.index && !at(contact.b).movable) || (contact.b == body.index && !at(contact.a).movable);
    };
    for (SolvedContact& contact : contacts_) {
      if (!own(contact)) continue;
      const bool is_a = contact.a == body.index;
      const SolverBody& other = at(is_a ? contact.b : contact.a);
      double impulse = 0;
      for (int k = 0; k < contact.count; ++k) {
        const SolvedPoint& point = contact.points[static_cast<std::size_t>(k)];
        if (point.gap > 0 && !(point.normal_impulse > 0)) continue;
        impulse += point.normal_impulse;
        const Vec3& arm = is_a ? point.arm_a : point.arm_b;
        const Vec3 led = other.linear + other.angular.cross(is_a ? point.arm_b : point.arm_a);
        const double apart = contact.normal.dot(body.linear + body.angular.cross(arm) - led) * (is_a ? -1 : 1);
        squeeze.speed = std::max(squeeze.speed, led.norm());
        squeeze.closing = std::max(squeeze.closing, -apart);
        squeeze.reach = std::max(squeeze.reach, arm.norm());
        if (squeeze.first == not_led) squeeze.first = other.index;
        squeeze.by_several = squeeze.by_several || squeeze.first != other.index;
      }
      if (!squeeze.hardest || impulse > squeeze.impulse) squeeze.hardest = &contact, squeeze.impulse = impulse;
    }
    if (!squeeze.by_several || !(squeeze.closing > unsatisfied * squeeze.speed)) continue;
    const Vec3 linear = body.linear;
    const double fastest = std::max(squeeze.speed, starts_[i].linear.norm());
    const double most_spin = std::max(squeeze.speed / squeeze.reach, starts_[i].angular.norm());
    if (linear.norm() > fastest) body.linear *= fastest / linear.norm();
    if (body.angular.norm() > most_spin) body.angular *= most_spin / body.angular.norm();
    // What it does not get, what presses it does not give.
    squeeze.hardest->points[0].total_friction +=
        (squeeze.hardest->b == body.index ? 1 : -1) / body.inverse_mass * (body.linear - linear);
    for (SolvedContact& contact : contacts_) {
      if (!own(contact)) continue;
      for (SolvedPoint& point : contact.points) {
        point.normal_impulse = point.kept_normal = 0;
        point.friction_impulse = point.kept_friction = Vec3::Zero();
      }
      contact.rolling_impulse = contact.kept_rolling = Vec3::Zero();
      contact.spin_impulse = contact.kept_spin = 0;
    }
  }
}

}  // namespace tweenfall::step
