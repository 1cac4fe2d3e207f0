#include "forces/flight.h"

#include <tweenfall/curves/rotation.h>

#include <functional>

#include "step/keyed_step.h"

namespace tweenfall::forces {

using state::Body;

namespace {

/// Beyond this a turn since the start of the step has no rate that is good for anything, rad.
constexpr double most_turn = 3;

/// Rate of a rotation vector, world axes, of what turns like this.
Vec3 turn_rate(const Vec3& turn, const Vec3& angular) {
  if (turn.cross(angular) == Vec3::Zero() || !(turn.squaredNorm() < most_turn * most_turn)) return angular;
  return right_jacobian_inverse(-turn) * angular;
}

/// What an integrator does not move: on its path, or at rest.
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
  glimpses_.resize(starts_.size());
  means_.resize(starts_.size());
  const auto rates_of = [&](double after, std::span<const Change> since, std::span<Change> rates) {
    find_rates(acting, loads, after, since, rates);
  };
  integrate(std::ref(rates_of), acting.dt, room_, means_);
  for (std::size_t k = 0; k < starts_.size(); ++k) {
    Load& load = loads[starts_[k].index];
    load.acceleration = load.end_acceleration = means_[k].linear;
    load.torque = means_[k].momentum;
    load.drag = load.angular_drag = load.angular_damping = 0;
  }
}

void Flight::find_rates(const Acting& acting, const std::vector<Load>& loads, double after,
                        std::span<const Change> since, std::span<Change> rates) {
  for (std::size_t k = 0; k < starts_.size(); ++k) {
    const Body& body = acting.bodies[starts_[k].index];
    const Vec3 momentum = starts_[k].momentum + since[k].momentum;
    Glimpse& at = glimpses_[k];
    at.center = body.center + since[k].center;
    at.linear = body.twist.linear + since[k].linear;
    at.rotation = exp_map(since[k].turn) * body.motion.pose.rotation;
    at.angular = at.rotation * (body.inverse_inertia * (at.rotation.conjugate() * momentum));
    rates[k].center = at.linear;
    rates[k].linear = acting.settings.gravity + body.force / body.mass.mass - body.linear_damping * at.linear;
    rates[k].turn = turn_rate(since[k].turn, at.angular);
    rates[k].momentum = body.torque - body.angular_damping * momentum;
  }
  for (const NumberedForce& entry : acting.forces) {
    if (const auto* spring = std::get_if<Spring>(&entry.force)) {
      if (!too_stiff(*spring, acting.bodies, loads)) add_spring(acting, *spring, after, rates);
      continue;
    }
    const auto* drag = std::get_if<Drag>(&entry.force);
    const auto* field = std::get_if<Field>(&entry.force);
    for (std::size_t k = 0; k < starts_.size(); ++k) {
      const double mass = acting.bodies[starts_[k].index].mass.mass;
      const Glimpse& at = glimpses_[k];
      if (drag) {
        rates[k].linear -= (drag->linear + drag->quadratic * at.linear.norm()) / mass * at.linear;
        rates[k].momentum -= drag->angular * at.angular;
      } else if (field) {
        rates[k].linear += (*field)(mass, at.center, at.linear, acting.time + after) / mass;
      }
    }
  }
}

void Flight::add_spring(const Acting& acting, const Spring& spring, double after, std::span<Change> rates) const {
  const Body* a = find_body(acting.bodies, spring.a);
  const Body* b = find_body(acting.bodies, spring.b);
  if (!a || (!b && spring.b != BodyId{})) return;  // an end was removed: the spring hangs loose
  const auto glimpse = [&](const Body& body, std::uint32_t index) {
    return slots_[index] == nobody ? led(body, after, acting.dt) : glimpses_[slots_[index]];
  };
  const Pull pull = pull_of(spring, *a, glimpse(*a, spring.a.index), b, b ? glimpse(*b, spring.b.index) : Glimpse{});
  const auto apply = [&](const Body& body, std::uint32_t index, const Vec3& force, const Vec3& arm) {
    if (slots_[index] == nobody) return;
    Change& rate = rates[slots_[index]];
    rate.linear += force / body.mass.mass;
    rate.momentum += arm.cross(force);
  };
  apply(*a, spring.a.index, pull.force, pull.arm_a);
  if (b) apply(*b, spring.b.index, -pull.force, pull.arm_b);
}

void Flight::land(std::uint32_t index, Body& body, double dt) const {
  const std::uint32_t slot = slots_[index];
  const Change& mean = means_[slot];
  body.center += dt * mean.center;
  body.twist.linear += dt * mean.linear;
  Quat rotation = exp_map(dt * mean.turn) * body.motion.pose.rotation;
  rotation.normalize();
  body.twist.angular = body.world_inverse_inertia(rotation) * (starts_[slot].momentum + dt * mean.momentum);
  body.follow_center(rotation);
}

}  // namespace tweenfall::forces
