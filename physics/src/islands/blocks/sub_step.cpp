#include "islands/blocks/block_solver.h"

#include <tweenfall/curves/rotation.h>

#include <Eigen/LU>
#include <algorithm>

/// How bodies move through a sub-step: forces begin it, and the velocities that the rows leave end it.

namespace tweenfall::blocks {

using forces::Load;
using state::Body;

namespace {

/// Up to this turn in a sub-step, the own change of a pressed body's spin comes from two evaluations of Euler's
/// equations.
constexpr double slow_turn = 0.05;

/// Angular velocity after a body's spin and torque have changed it for the time h, to second order.
Vec3 spun(const Body& body, const Quat& rotation, const Vec3& angular, const Vec3& torque, double h) {
  const Quat back = rotation.conjugate();
  const Vec3 spin = back * angular;
  const Vec3 turning = back * torque;
  const auto rate = [&](const Vec3& at) { return forces::rate_of_spin(body, turning, at); };
  Vec3 next = spin + h * rate(spin + 0.5 * h * rate(spin));
  if (torque == Vec3::Zero())
    next = forces::bounded_spin(body.mass().inertia, 0.5 * spin.dot(body.mass().inertia * spin), next);
  return rotation * next;
}

}  // namespace

void BlockSolver::begin_sub_step(const std::vector<Body>& bodies, const std::vector<Load>& loads, double dt,
                                 int sub_steps, int sub_step) {
  const double h = dt / sub_steps;
  lead(dt, sub_steps, sub_step);
  carries_on_ = sub_step > 0 && joints_.empty() && holds_.empty();
  each_body([&](std::size_t i) {
    const BodyPace& pace = paces_[i];
    BodyLanes& velocity = velocities_[i];
    std::copy_n(displacements_[i].linear, 4, sub_starts_[i].lanes);
    if (pace.steady) {
      starts_[i] = velocity;
      for (int k = 0; k < 4; ++k) velocity.linear[k] += pace.acceleration[k] * h;
      carry_on(i, rebounded_ ? ended_[i] : starts_[i]);
      return;
    }
    IslandBody& entry = bodies_[i];
    entry.sub_step_center = entry.center;
    entry.sub_step_rotation = entry.rotation;
    if (pace.movable) {
      starts_[i] = velocity;
      begin_sub_step_of(i, bodies[entry.index], loads[entry.index], h);
      carry_on(i, entry.isotropic && !rebounded_ ? starts_[i] : ended_[i]);
    } else if (entry.led == step::not_led) {
      starts_[i] = {};
    }
  });
}

/// What forces do in the sub-step to a body that something else than contacts and its weight stirs.
void BlockSolver::begin_sub_step_of(std::size_t place, const Body& body, const Load& load, double h) {
  BodyPace& pace = paces_[place];
  IslandBody& entry = bodies_[place];
  BodyLanes& velocity = velocities_[place];
  for (int k = 0; k < 3; ++k)
    velocity.linear[k] = (velocity.linear[k] + pace.acceleration[k] * h) / (1 + entry.drag * h);
  entry.followed = !pace.pressed && !pace.even && !entry.jointed;
  pace.pressed = false;
  if (pace.even) return;
  const Vec3 angular = angular_of(velocity);
  if (entry.jointed && !spins_.empty() && !(load.angular_drag > 0)) {
    const Vec3 damped = angular / (1 + load.angular_damping * h);
    const Vec3 spin = spins_.begin_sub_step(place, body, load, entry.rotation, damped, h);
    if (spins_.follows(place)) return set(velocity.angular, spin);
  } else if (!spins_.empty()) {
    spins_.leave(place);
  }
  const bool slow = !entry.followed && angular.squaredNorm() * h * h <= slow_turn * slow_turn;
  if (!slow || load.angular_drag > 0) {
    const forces::Spin spin = forces::turned(body, {entry.rotation, angular}, load, h);
    set(velocity.angular, spin.angular);
    entry.free_rotation = spin.rotation;
  } else {
    const Vec3 damped = angular / (1 + load.angular_damping * h);
    set(velocity.angular, spun(body, entry.rotation, damped, load.torque, h));
  }
}

/// @param ended  velocity that the passes of the sub-step before left
void BlockSolver::carry_on(std::size_t place, const BodyLanes& ended) {
  BodyLanes& velocity = velocities_[place];
  const BodyLanes begun = velocity;
  if (carries_on_)
    for (int k = 0; k < 4; ++k) {
      velocity.linear[k] += ended.linear[k] - begun_[place].linear[k];
      velocity.angular[k] += ended.angular[k] - begun_[place].angular[k];
    }
  begun_[place] = begun;
}

/// A led body moves through the sub-step by its mean velocity, so that it is where its path is at the end.
void BlockSolver::lead(double dt, int sub_steps, int sub_step) {
  const double from = static_cast<double>(sub_step) / sub_steps;
  const double to = static_cast<double>(sub_step + 1) / sub_steps;
  for (step::LedBody& led : led_) {
    set(starts_[led.place].linear, led.ending.linear);
    set(starts_[led.place].angular, led.ending.angular);
    led.mean = led.course.mean_between(from, to, dt);
    led.ending = led.course.velocity(to, dt);
    set(velocities_[led.place].linear, led.mean.linear);
    set(velocities_[led.place].angular, led.mean.angular);
  }
}

/// Afterwards the bodies it carries get the velocity at the end.
void BlockSolver::end_lead() {
  for (const step::LedBody& led : led_) {
    set(velocities_[led.place].linear, led.ending.linear);
    set(velocities_[led.place].angular, led.ending.angular);
  }
  if (!led_.empty()) contacts_.end_ride();
}

void BlockSolver::prepare_again(const std::vector<Body>& bodies) {
  if (!any_stale_ && joints_.empty()) return;
  any_stale_ = false;
  each_body([&](std::size_t i) {
    IslandBody& entry = bodies_[i];
    double& turned = turns_[i].turned;
    entry.stale = !entry.round && turned > (entry.led == step::not_led ? turned_enough_ : 0);
    if (entry.stale) {
      turned = 0;
      const Quat turn = turns_[i].after(entry.rotation) * entry.start_rotation.conjugate();
      std::copy_n(turn.coeffs().data(), 4, entry.turn.rotation);
      std::copy_n(displacements_[i].angular, 3, entry.turn.angle);
    }
    if (!entry.movable) return;
    if (entry.stale || (!joints_.empty() && !bodies[entry.index].spherical()))
      entry.inverse_inertia = entry.given * bodies[entry.index].world_inverse_inertia(entry.rotation);
  });
  const Kernels& kernels = fastest_kernels();
  by_color([&](const Rows& some) { kernels.prepare_again(some, carries_on_); });
  contacts_.prepare_drifts(bodies_, true);
}

void BlockSolver::include_turn(std::size_t place) {
  BodyTurn& turn = turns_[place];
  bodies_[place].rotation = turn.after(bodies_[place].rotation);
  std::fill_n(turn.latest, 3, 0.0);
}

void BlockSolver::end_sub_step(double h) {
  stale_.assign(work_.range_count(bodies_.size() - 1, worth_a_part), 0);
  work_.numbered_ranges(bodies_.size() - 1, worth_a_part, [&](std::size_t part, std::size_t begin, std::size_t end) {
    bool stale = false;
    for (std::size_t i = begin + 1; i < end + 1; ++i) {
      BodyPace& pace = paces_[i];
      const BodyLanes& velocity = velocities_[i];
      BodyLanes& displacement = displacements_[i];
      pace.pressed = pace.movable && lags_[i].lanes[3] != 0;
      pace.touched = pace.touched || pace.pressed;
      double moved[3];
      for (int k = 0; k < 3; ++k) {
        moved[k] = (velocity.linear[k] + lags_[i].lanes[k]) * h;
        displacement.linear[k] += moved[k];
      }
      if (pace.unturned) {
        // A rolling body has the mean of its spins.
        const double kept = pace.impact ? 1 : 0.5;
        for (int k = 0; k < 3; ++k)
          displacement.angular[k] += (kept * velocity.angular[k] + (1 - kept) * starts_[i].angular[k]) * h;
        continue;
      }
      if (pace.steady) {
        const Vec3 turning = angular_of(velocity) * h;
        for (int k = 0; k < 3; ++k) displacement.angular[k] += turning[k];
        BodyTurn& turn = turns_[i];
        const double size = turning.norm();
        turn.turned += size;
        stale = stale || turn.turned > turned_enough_;
        if (size > BodyTurn::short_turn) include_turn(i);
        turn.follow_by(turning);
        if (turn.far()) include_turn(i);
        continue;
      }
      IslandBody& entry = bodies_[i];
      for (int k = 0; k < 3; ++k) entry.center[k] += moved[k];
      Vec3 angular = angular_of(velocity);
      if (entry.movable && entry.round && !pace.impact && !entry.jointed)
        angular = 0.5 * (angular + angular_of(starts_[i]));
      if (angular == Vec3::Zero()) continue;
      const Vec3 turning = angular * h;
      for (int k = 0; k < 3; ++k) displacement.angular[k] += turning[k];
      if (!entry.round) {
        turns_[i].turned += turning.norm();
        stale = stale || turns_[i].turned > (entry.led == step::not_led ? turned_enough_ : 0);
      }
      if (entry.followed && !pace.pressed) {
        // The spin of free flight keeps its energy only with the rotation that belongs to it.
        entry.rotation = entry.free_rotation;
        continue;
      }
      entry.rotation = exp_map(turning) * entry.rotation;
      entry.rotation.normalize();
    }
    stale_[part] = stale ? 1 : 0;
  });
  for (const char stale : stale_) any_stale_ = any_stale_ || stale != 0;
}

/// See Solver::carry_spins; but what was pressed in the sub-step before turns from where this one began.
void BlockSolver::carry_spins(double h) {
  work_.ranges(uneven_.size(), worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t i = uneven_[k];
      const IslandBody& entry = bodies_[i];
      if (!paces_[i].pressed || entry.jointed || entry.held || bounds_spin(i, h)) continue;
      const Quat& from = entry.followed ? entry.free_rotation : entry.sub_step_rotation;
      set(velocities_[i].angular, entry.rotation * (from.conjugate() * angular_of(velocities_[i])));
    }
  });
}

bool BlockSolver::bounds_spin(std::uint32_t place, double h) const {
  return paces_[place].slender || angular_of(velocities_[place]).squaredNorm() * h * h > 1;
}

/// See Solver::bound_spins.
void BlockSolver::bound_spins(const std::vector<Body>& bodies, double h) {
  work_.ranges(uneven_.size(), worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      BodyLanes& velocity = velocities_[uneven_[k]];
      const Vec3 angular = angular_of(velocity);
      if (!bounds_spin(uneven_[k], h)) continue;
      const IslandBody& entry = bodies_[uneven_[k]];
      const double energy = 0.5 * angular.dot(entry.inverse_inertia.inverse() * angular);
      set(velocity.angular, forces::bounded_spin(bodies[entry.index].world_inertia(entry.rotation), energy, angular));
    }
  });
}

}  // namespace tweenfall::blocks
