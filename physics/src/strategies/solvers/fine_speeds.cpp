#include "strategies/solvers/fine_speeds.h"

namespace tweenfall::strategies {

FineSpeeds::FineSpeeds(const Gathering& island) : island_(island), touched_(island.parties.size()) {
  for (const Party& party : island.parties)
    speeds_.push_back({party.linear.cast<long double>(), party.angular.cast<long double>()});
}

void FineSpeeds::push(const Touch& touch, long double impulse) {
  const Fine along = impulse * touch.normal.cast<long double>();
  const auto give = [&](std::uint32_t end, const Vec3& arm, long double way) {
    const Party& party = island_.parties[end];
    speeds_[end].linear += way * party.inverse_mass * along;
    speeds_[end].angular += way * (party.inverse_inertia.cast<long double>() * arm.cast<long double>().cross(along));
    touched_[end] = 1;
  };
  give(touch.a, touch.arm_a, -1);
  give(touch.b, touch.arm_b, 1);
}

long double FineSpeeds::parting(const Touch& touch) const {
  const Speed &a = speeds_[touch.a], &b = speeds_[touch.b];
  const Fine at_a = a.linear + a.angular.cross(touch.arm_a.cast<long double>());
  const Fine at_b = b.linear + b.angular.cross(touch.arm_b.cast<long double>());
  return touch.normal.cast<long double>().dot(at_b - at_a);
}

void FineSpeeds::tell(Gathering& island) const {
  for (std::size_t i = 0; i < speeds_.size(); ++i) {
    if (touched_[i] == 0) continue;
    Party& party = island.parties[i];
    party.linear = speeds_[i].linear.cast<double>();
    party.angular = speeds_[i].angular.cast<double>();
    party.touched = true;
  }
}

}  // namespace tweenfall::strategies
