#include "forces/flight.h"

#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <array>
#include <functional>

#include "step/keyed_step.h"

namespace tweenfall::forces {

using state::Body;

namespace {

/// Beyond this, a turn since the start of the step has no useful rate, rad.
constexpr double most_turn = 3;

/// Rate of a rotation vector, world axes, for a body with this turn and angular velocity.
Vec3 turn_rate(const Vec3& turn, const Vec3& angular) {
  if (turn.cross(angular) == Vec3::Zero() || !(turn.squaredNorm() < most_turn * most_turn)) return angular;
  return right_jacobian_inverse(-turn) * angular;
}

constexpr std::size_t numbers = 12;
constexpr std::array<std::uint8_t, numbers> are_places{1, 1, 1, 0, 0, 0, 1, 1, 1, 0, 0, 0};

Change change_of(std::span<const double> state, std::size_t body) {
  const double* const at = state.data() + body * numbers;
  return {Vec3(at[0], at[1], at[2]), Vec3(at[3], at[4], at[5]), Vec3(at[6], at[7], at[8]), Vec3(at[9], at[10], at[11])};
}

void put(const Change& change, std::span<double> state, std::size_t body) {
  double* at = state.data() + body * numbers;
  for (const Vec3* part : {&change.center, &change.linear, &change.turn, &change.momentum})
    for (int i = 0; i < 3; ++i) *at++ = (*part)[i];
}

/// A body that the integrator does not move: on its path, or at rest.
Glimpse led(const Body& body, double after, double dt) {
  if (!body.immovable()) return {body.center, Vec3::Zero(), Vec3::Zero(), body.motion.pose.rotation};
  const step::KeyedCourse course = step::keyed_course(body, dt);
  const double share = after / dt;
  const Twist mean = course.mean_between(0, share, dt), twist = course.velocity(share, dt);
  return {body.center + after * mean.linear, twist.linear, twist.angular,
          exp_map(after * mean.angular) * body.motion.pose.rotation};
}

}  // namespace

void Flight::gather(const Acting& acting, std::span<const std::uint32_t> watched, Integrate* integrate,
                    std::vector<Load>& loads) {
  slots_.assign(acting.bodies.size(), nobody);
  starts_.clear();
  for (const std::uint32_t i : watched) {
    const Body& body = acting.bodies[i];
    if (body.immovable() || body.asleep) continue;
    slots_[i] = static_cast<std::uint32_t>(starts_.size());
    starts_.push_back({i, body.world_inertia(body.motion.pose.rotation) * body.twist.angular});
  }
  const std::size_t count = starts_.size();
  glimpses_.resize(count);
  rates_.resize(count);
  resisted_.assign(count, {0, 0});
  means_.resize(count * numbers);
  sizes_.resize(count * numbers);
  for (std::size_t k = 0; k < count; ++k) {
    const Body& body = acting.bodies[starts_[k].index];
    put({Vec3::Constant(body.center.norm()), Vec3::Constant(body.twist.linear.norm()), Vec3::Ones(),
         Vec3::Constant(starts_[k].momentum.norm())},
        sizes_, k);
  }
  tie(acting, watched, loads);
  const auto rates_of = [&](double after, std::span<const double> since, std::span<double> rates) {
    find_rates(acting, watched, loads, after, since, rates);
  };
  integrate({std::ref(rates_of), numbers, 3, are_places, sizes_, ties_, turns_}, acting.dt, room_, means_);
  for (std::size_t k = 0; k < count; ++k) {
    Load& load = loads[starts_[k].index];
    const Change mean = change_of(means_, k);
    load.acceleration = load.end_acceleration = mean.linear;
    load.torque = mean.momentum;
    const Body& body = acting.bodies[starts_[k].index];
    load.drag = load.angular_drag = load.angular_damping = 0;
    load.met_drag = body.makeup->linear_damping + resisted_[k].first / body.mass().mass;
    load.met_angular_drag = resisted_[k].second;
  }
}

void Flight::tie(const Acting& acting, std::span<const std::uint32_t> watched, const std::vector<Load>& loads) {
  const auto count = static_cast<std::uint32_t>(starts_.size());
  ties_.resize(count);
  turns_.assign(count, 0);
  for (std::uint32_t k = 0; k < count; ++k) ties_[k] = k;
  const auto root = [&](std::uint32_t k) {
    while (ties_[k] != k) k = ties_[k] = ties_[ties_[k]];
    return k;
  };
  std::vector<std::pair<std::uint32_t, std::uint32_t>> both;
  for (const NumberedForce& entry : acting.forces) {
    const std::optional<Spring> spring = spring_between(entry.force, 1, acting.bodies);
    if (spring && too_stiff(*spring, acting.bodies, loads)) continue;
    each_tie(entry, acting.bodies, watched, [&](std::uint32_t one, std::uint32_t other) {
      const std::uint32_t a = slots_[one], b = slots_[other];
      if (a == nobody || b == nobody || a == b) return;
      const auto [less, more] = std::minmax({root(a), root(b)});
      ties_[more] = less;
      both.emplace_back(std::max(a, b), std::min(a, b));
    });
  }
  for (std::uint32_t k = 0; k < count; ++k) ties_[k] = root(k);
  std::sort(both.begin(), both.end());
  std::vector<char> taken;
  for (auto tied = both.cbegin(); tied != both.cend();) {
    const std::uint32_t later = tied->first;
    taken.clear();
    for (; tied != both.cend() && tied->first == later; ++tied) {
      const std::uint32_t turn = turns_[tied->second];
      if (turn >= taken.size()) taken.resize(turn + std::size_t{1}, 0);
      taken[turn] = 1;
    }
    turns_[later] = static_cast<std::uint32_t>(std::find(taken.begin(), taken.end(), 0) - taken.begin());
  }
}

/// Within the step, at the states that the integrator evaluates.
class Flight::Amid : public Moment {
 public:
  Amid(const Flight& flight, const Acting& acting, double after)
      : Moment(acting.bodies, acting.settings.gravity, acting.time + after, after >= acting.dt ? Side::in : Side::out),
        flight_(flight),
        after_(after),
        dt_(acting.dt) {}
  [[nodiscard]] Glimpse of(std::uint32_t body) const override {
    const std::uint32_t slot = flight_.slots_[body];
    return slot == nobody ? led(bodies[body], after_, dt_) : flight_.glimpses_[slot];
  }

 private:
  const Flight& flight_;
  double after_, dt_;
};

void Flight::find_rates(const Acting& acting, std::span<const std::uint32_t> watched, const std::vector<Load>& loads,
                        double after, std::span<const double> since, std::span<double> rates) {
  for (std::size_t k = 0; k < starts_.size(); ++k) {
    const Body& body = acting.bodies[starts_[k].index];
    const Change changed = change_of(since, k);
    const Vec3 momentum = starts_[k].momentum + changed.momentum;
    Glimpse& at = glimpses_[k];
    at.center = body.center + changed.center;
    at.linear = body.twist.linear + changed.linear;
    at.rotation = exp_map(changed.turn) * body.motion.pose.rotation;
    at.angular = at.rotation * (body.inverse_inertia() * (at.rotation.conjugate() * momentum));
    rates_[k].center = at.linear;
    rates_[k].linear = acting.settings.gravity + body.steady_force(acting.settings.gravity) / body.mass().mass -
                       body.makeup->linear_damping * at.linear;
    rates_[k].turn = turn_rate(changed.turn, at.angular);
    rates_[k].momentum = body.torque() - body.makeup->angular_damping * momentum;
  }
  std::ranges::fill(resisted_, std::pair(0.0, 0.0));
  const Amid moment(*this, acting, after);
  for (const NumberedForce& entry : acting.forces) {
    const double strength = entry.settings.strength.at(moment.time, moment.side);
    if (named(entry.force).alone && !std::holds_alternative<Push>(entry.force)) {
      const std::optional<Spring> spring = spring_between(entry.force, strength, acting.bodies);
      if (spring && !too_stiff(*spring, acting.bodies, loads)) add_spring(acting, *spring, moment);
      continue;
    }
    each_acted(entry, acting.bodies, watched, [&](std::uint32_t i) {
      if (slots_[i] == nobody) return;
      const Glimpse& at = glimpses_[slots_[i]];
      const double mass = acting.bodies[i].mass().mass;
      const Effect effect = effect_of(entry.force, strength, {acting.bodies[i], at}, moment);
      Change& rate = rates_[slots_[i]];
      if (effect.force != Vec3::Zero()) rate.linear += effect.force / mass;
      if (effect.torque != Vec3::Zero()) rate.momentum += effect.torque;
      rate.linear -= effect.resistance / mass * (at.linear - effect.medium);
      rate.momentum -= effect.angular_resistance * at.angular;
      resisted_[slots_[i]].first += effect.resistance;
      resisted_[slots_[i]].second += effect.angular_resistance;
    });
  }
  for (std::size_t k = 0; k < starts_.size(); ++k) put(rates_[k], rates, k);
}

void Flight::add_spring(const Acting& acting, const Spring& spring, const Moment& moment) {
  const Body* a = find_body(acting.bodies, spring.a);
  const Body* b = find_body(acting.bodies, spring.b);
  const Pull pull = pull_of(spring, *a, moment.of(spring.a.index), b, b ? moment.of(spring.b.index) : Glimpse{});
  const auto apply = [&](const Body& body, std::uint32_t index, const Vec3& force, const Vec3& arm) {
    if (slots_[index] == nobody) return;
    Change& rate = rates_[slots_[index]];
    rate.linear += force / body.mass().mass;
    rate.momentum += arm.cross(force);
  };
  apply(*a, spring.a.index, pull.force, pull.arm_a);
  if (b) apply(*b, spring.b.index, -pull.force, pull.arm_b);
}

void Flight::land(std::uint32_t index, Body& body, double dt) const {
  const std::uint32_t slot = slots_[index];
  const Change mean = change_of(means_, slot);
  body.center += dt * mean.center;
  body.twist.linear += dt * mean.linear;
  Quat rotation = exp_map(dt * mean.turn) * body.motion.pose.rotation;
  rotation.normalize();
  body.twist.angular = body.world_inverse_inertia(rotation) * (starts_[slot].momentum + dt * mean.momentum);
  body.follow_center(rotation);
}

}  // namespace tweenfall::forces
