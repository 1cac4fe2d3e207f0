#include "islands/blocks/block_solver.h"

#include <tweenfall/curves/rotation.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "step/softness.h"

namespace tweenfall::blocks {

using contacts::ContactConstraint;
using forces::Load;
using state::Body;

namespace {

/// Up to this turn in a sub-step a pressed body's spin changes by itself as two evaluations of Euler's equations say.
constexpr double slow_turn = 0.05;

/// Of the speed that a contact's impulses give, a change that no longer matters.
constexpr double settled = 1e-12;

/// Lanes that another lane's contact makes do more than their own adds nothing, which may turn a -0 into a 0: it must
/// not tell which contacts share a block.
Vec3 without_sign_of_zero(const Vec3& value) {
  return {value.x() + 0.0, value.y() + 0.0, value.z() + 0.0};
}

constexpr BodyLag pressed_still = {{0, 0, 0, 1}};

/// Angular velocity after the time h in which a body's spin and the torque on it change it, to second order.
Vec3 spun(const Body& body, const Quat& rotation, const Vec3& angular, const Vec3& torque, double h) {
  const Quat back = rotation.conjugate();
  const Vec3 spin = back * angular;
  const Vec3 turning = back * torque;
  const auto rate = [&](const Vec3& at) -> Vec3 {
    return body.inverse_inertia() * (turning - at.cross(body.mass().inertia * at));
  };
  Vec3 next = spin + h * rate(spin + 0.5 * h * rate(spin));
  if (torque == Vec3::Zero())
    next = forces::bounded_spin(body.mass().inertia, 0.5 * spin.dot(body.mass().inertia * spin), next);
  return rotation * next;
}

}  // namespace

/// Gives all bodies of islands their places.
void BlockSolver::number(std::span<const islands::IslandContents> islands) {
  for (const std::uint32_t index : indices_)
    if (index < places_.size()) places_[index] = 0;
  indices_.assign(1, 0xffffffffu);
  island_of_.assign(1, 0);
  std::uint32_t number = 0;
  const auto add = [&](std::uint32_t index) {
    if (places_[index] != 0) return;
    places_[index] = static_cast<std::uint32_t>(indices_.size());
    indices_.push_back(index);
    island_of_.push_back(number);
  };
  for (const islands::IslandContents& island : islands) {
    for (const ContactConstraint* contact : island.contacts) {
      add(contact->a);
      add(contact->b);
    }
    for (const joints::JointLink* link : island.joints)
      for (const std::uint32_t end : {link->a, link->b})
        if (end != joints::JointLink::world) add(end);
    for (const step::SpringRow* spring : island.springs)
      for (const std::uint32_t end : {spring->a, spring->b})
        if (end != step::SpringRow::world) add(end);
    ++number;
  }
}

void BlockSolver::take(std::size_t place, const Body& body, const Load& load, Integrator integrator) {
  IslandBody& entry = bodies_[place] = {};
  BodyPace& pace = paces_[place] = {};
  BodyLanes& velocity = velocities_[place] = {};
  displacements_[place] = {};
  lags_[place] = {};
  Traits& traits = traits_[place] = {};
  entry.index = indices_[place];
  entry.round = body.round();
  entry.movable = pace.movable = !body.immovable() && !body.asleep;
  entry.conveys = body.conveys;
  if (body.conveys) {
    entry.surface = body.surface();
    traits.conveys = true;
  }
  entry.center = entry.start_center = body.center;
  entry.rotation = entry.start_rotation = body.motion.pose.rotation;
  traits.immovable = body.immovable();
  if (!entry.movable) return;
  entry.inverse_mass = 1 / body.mass().mass;
  entry.drag = load.drag;
  entry.isotropic = body.spherical();
  entry.inverse_moment = body.spherical() ? body.inverse_inertia()(0, 0) : 0;
  entry.inverse_inertia =
      body.spherical() ? body.inverse_inertia() : body.world_inverse_inertia(body.motion.pose.rotation);
  pace.mass = body.mass().mass;
  pace.moment = body.mass().inertia(0, 0);
  set(pace.acceleration, integrator == Integrator::exact_quadratic
                             ? Vec3(0.5 * (load.acceleration + load.end_acceleration))
                             : load.acceleration);
  pace.even = body.spherical() && load.torque == Vec3::Zero() && !(load.angular_drag > 0 || load.angular_damping > 0);
  pace.steady = pace.even && !(load.drag > 0);
  pace.unturned = pace.steady && entry.round;
  traits.uneven = !body.spherical();
  traits.driven = body.drive.owner() == Owner::driven;
  set(velocity.linear, without_sign_of_zero(body.twist.linear));
  set(velocity.angular, without_sign_of_zero(body.twist.angular));
}

void BlockSolver::gather(const std::vector<Body>& bodies, const std::vector<Load>& loads,
                         std::span<const islands::IslandContents> islands, Integrator integrator, double dt) {
  number(islands);
  const std::size_t count = indices_.size();
  bodies_.resize(count);
  paces_.resize(count);
  velocities_.resize(count);
  displacements_.resize(count);
  lags_.resize(count);
  starts_.resize(count);
  sub_starts_.resize(count);
  traits_.resize(count);
  bodies_[0] = {};
  bodies_[0].index = indices_[0];
  paces_[0] = {};
  velocities_[0] = displacements_[0] = {};
  lags_[0] = {};
  each_body([&](std::size_t i) { take(i, bodies[indices_[i]], loads[indices_[i]], integrator); });
  uneven_.clear();
  rebounds_.clear();  // of the island before
  led_.clear();
  bouncy_ = conveyed_ = any_stale_ = driven_ = false;
  for (std::uint32_t i = 1; i < count; ++i) {
    conveyed_ = conveyed_ || traits_[i].conveys;
    driven_ = driven_ || traits_[i].driven;
    if (traits_[i].uneven) uneven_.push_back(i);
    if (!traits_[i].immovable) continue;
    const step::KeyedCourse course = step::keyed_course(bodies[indices_[i]], dt);
    if (course.still()) continue;
    bodies_[i].led = static_cast<std::uint32_t>(led_.size());
    const Twist start = course.velocity(0, dt);
    led_.push_back({i, course, start, start});
    set(velocities_[i].linear, start.linear);
    set(velocities_[i].angular, start.angular);
  }
  for (const islands::IslandContents& island : islands)
    for (const joints::JointLink* link : island.joints)
      for (const std::uint32_t end : {link->a, link->b})
        if (end != joints::JointLink::world) bodies_[places_[end]].jointed = true;
}

/// @param trembling  in a heap what presses down passes on to all sides: what it makes of so much time is a tremble in
/// any direction, s
void BlockSolver::foresee(std::span<ContactConstraint* const> contacts, const std::vector<Load>& loads,
                          double trembling, double dt) {
  closings_.resize(contacts.size());
  marks_.resize(contacts.size());
  work_.ranges(contacts.size(), worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      ContactConstraint& contact = *contacts[i];
      const std::uint32_t a = places_[contact.a], b = places_[contact.b];
      closings_[i] = contacts::closing_of(contact.manifold.normal, loads[contact.a], loads[contact.b], dt);
      if (trembling > 0)
        closings_[i].tremble =
            std::max(closings_[i].tremble,
                     trembling * std::max(loads[contact.a].acceleration.norm(), loads[contact.b].acceleration.norm()));
      contacts::foresee(contact, {linear_of(velocities_[a]), angular_of(velocities_[a])},
                        {linear_of(velocities_[b]), angular_of(velocities_[b])}, closings_[i], dt);
      marks_[i] = {contact.impact, contact.restitution > 0, false};
    }
  });
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    bouncy_ = bouncy_ || marks_[i].springs_back;
    if (marks_[i].impact) paces_[places_[contacts[i]->a]].impact = paces_[places_[contacts[i]->b]].impact = true;
  }
}

void BlockSolver::begin_sub_step(const std::vector<Body>& bodies, const std::vector<Load>& loads, double dt,
                                 int sub_steps, int sub_step) {
  const double h = dt / sub_steps;
  lead(dt, sub_steps, sub_step);
  each_body([&](std::size_t i) {
    BodyPace& pace = paces_[i];
    BodyLanes& velocity = velocities_[i];
    BodyLanes& start = starts_[i];
    std::copy_n(displacements_[i].linear, 4, sub_starts_[i].lanes);
    if (pace.steady) {
      start = velocity;
      for (int k = 0; k < 4; ++k) velocity.linear[k] += pace.acceleration[k] * h;
      return;
    }
    IslandBody& entry = bodies_[i];
    entry.sub_step_center = entry.center;
    entry.sub_step_rotation = entry.rotation;
    if (!pace.movable) {
      if (entry.led == step::not_led) start = {};
      return;
    }
    start = velocity;
    for (int k = 0; k < 3; ++k)
      velocity.linear[k] = (velocity.linear[k] + pace.acceleration[k] * h) / (1 + entry.drag * h);
    entry.followed = !pace.pressed && !pace.even && !entry.jointed;
    pace.pressed = false;
    if (pace.even) return;
    const Body& body = bodies[entry.index];
    const Load& load = loads[entry.index];
    const Vec3 angular = angular_of(velocity);
    if (entry.jointed && !spins_.empty() && !(load.angular_drag > 0)) {
      const Vec3 damped = angular / (1 + load.angular_damping * h);
      const Vec3 spin = spins_.begin_sub_step(i, body, load, entry.rotation, damped, h);
      if (spins_.follows(i)) return set(velocity.angular, spin);
    } else if (!spins_.empty()) {
      spins_.leave(i);
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
  });
}

/// What is led goes through the sub-step by its mean velocity, so that it is where its path is at the end.
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

/// Then what it carries gets its velocity there.
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
    entry.stale = !entry.round && entry.turned > (entry.led == step::not_led ? turned_enough_ : 0);
    if (entry.stale) entry.turned = 0;
    if (!entry.movable) return;
    if (entry.stale || (!joints_.empty() && !bodies[entry.index].spherical()))
      entry.inverse_inertia = entry.given * bodies[entry.index].world_inverse_inertia(entry.rotation);
  });
  work_.ranges(contacts_.blocks.size(), blocks_worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const ContactBlock& block = contacts_.blocks[i];
      for (int lane = 0; lane < lane_count; ++lane)
        if (contacts_.origins[i][static_cast<std::size_t>(lane)] &&
            (bodies_[block.a[lane]].stale || bodies_[block.b[lane]].stale))
          contacts_.prepare(i, lane, bodies_, displacements_.data());
    }
  });
}

/// Where a contact holds a body, the velocity after the impulses counts: a mean would leave every tremble undamped.
void BlockSolver::find_lags() {
  each_body([&](std::size_t i) {
    const double share = paces_[i].movable ? 0.5 : 0;
    for (int k = 0; k < 4; ++k) lags_[i].lanes[k] = share * (starts_[i].linear[k] - velocities_[i].linear[k]);
  });
  const Kernels& kernels = fastest_kernels();
  by_color([&](const Rows& some) { kernels.hold(some); });
  each_body([&](std::size_t i) {
    if (paces_[i].impact && lags_[i].lanes[3] != 0) lags_[i] = pressed_still;
  });
  if (!holds_.empty())
    for (std::size_t i = 1; i < bodies_.size(); ++i)
      if (bodies_[i].held && bodies_[i].movable) lags_[i] = pressed_still;
  if (!joints_.empty()) find_lags_of_jointed();
}

/// What joints alone hold together flies as one: its center of mass has the mean velocity, and nothing else is free to
/// tremble. What hangs on something is held as by a contact. A joint that is slack holds nothing.
void BlockSolver::find_lags_of_jointed() {
  for (IslandBody& body : bodies_) body.jointed = false;
  jointed_.assign(island_of_.back() + std::size_t{1}, {});
  joints_.find_held(bodies_, [this](std::uint32_t place) { jointed_[island_of_[place]].free = false; });
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    if (!bodies_[i].jointed || !bodies_[i].movable) continue;
    JointedFlight& its = jointed_[island_of_[i]];
    its.free = its.free && lags_[i].lanes[3] == 0 && !bodies_[i].held;
    its.mass += paces_[i].mass;
    its.gained += paces_[i].mass * (linear_of(velocities_[i]) - linear_of(starts_[i]));
  }
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    if (!bodies_[i].jointed || !bodies_[i].movable) continue;
    const JointedFlight& its = jointed_[island_of_[i]];
    lags_[i] = pressed_still;
    if (its.free) set(lags_[i].lanes, -0.5 / its.mass * its.gained);
  }
}

/// Joints and motors that contradict each other may ask for any speed. What would turn or go further in a sub-step than
/// can be followed keeps the velocity that it had, and the joints forget what they asked for.
void BlockSolver::tame_jointed(const std::vector<Body>& bodies, double h) {
  constexpr double farthest_turn = 2;  // rad
  constexpr double farthest = 100;     // of the body's size
  const auto is_wild = [&](std::size_t i) {
    if (!bodies_[i].jointed || !bodies_[i].movable) return false;
    const BodyLanes& velocity = velocities_[i];
    const double gained = (linear_of(velocity) - linear_of(starts_[i])).squaredNorm() * h * h;
    const double reach = farthest * bodies[bodies_[i].index].radius();
    return !(gained <= reach * reach && angular_of(velocity).squaredNorm() * h * h <= farthest_turn * farthest_turn);
  };
  wild_.assign(work_.range_count(bodies_.size() - 1, worth_a_part), 0);
  work_.numbered_ranges(bodies_.size() - 1, worth_a_part, [&](std::size_t part, std::size_t begin, std::size_t end) {
    bool some = false;
    for (std::size_t i = begin + 1; i < end + 1 && !some; ++i) some = is_wild(i);
    wild_[part] = some ? 1 : 0;
  });
  if (std::find(wild_.begin(), wild_.end(), 1) == wild_.end()) return;
  jointed_.assign(island_of_.back() + std::size_t{1}, {});
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    if (!is_wild(i)) continue;
    jointed_[island_of_[i]].wild = true;
    BodyLanes& velocity = velocities_[i];
    velocity = starts_[i];
    Vec3 angular = angular_of(velocity);
    const double turn = angular.norm() * h;
    if (turn > farthest_turn) set(velocity.angular, angular * (0.5 * farthest_turn / turn));
  }
  joints_.forget([this](std::uint32_t place) { return jointed_[island_of_[place]].wild; });
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
        // What rolls has the mean of its spins.
        const double kept = pace.impact ? 1 : 0.5;
        for (int k = 0; k < 3; ++k)
          displacement.angular[k] += (kept * velocity.angular[k] + (1 - kept) * starts_[i].angular[k]) * h;
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
        entry.turned += turning.norm();
        stale = stale || entry.turned > (entry.led == step::not_led ? turned_enough_ : 0);
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

/// See Solver::bound_spins.
void BlockSolver::bound_spins(const std::vector<Body>& bodies, double h) {
  work_.ranges(uneven_.size(), worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      BodyLanes& velocity = velocities_[uneven_[k]];
      const Vec3 angular = angular_of(velocity);
      if (!(angular.squaredNorm() * h * h > 1)) continue;
      const IslandBody& entry = bodies_[uneven_[k]];
      const double energy = 0.5 * angular.dot(entry.inverse_inertia.inverse() * angular);
      set(velocity.angular, forces::bounded_spin(bodies[entry.index].world_inertia(entry.rotation), energy, angular));
    }
  });
}

/// What impulses gave to the spins of jointed bodies turns along with them. Most of it is known when the rows begin; of
/// the rest joints see what is left with the next sub-step.
void BlockSolver::follow_spins(const std::vector<Body>& bodies) {
  if (spins_.empty()) return;
  work_.ranges(uneven_.size(), worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t i = uneven_[k];
      if (!spins_.follows(i)) continue;
      set(velocities_[i].angular, spins_.followed(i, bodies[indices_[i]], angular_of(velocities_[i])));
    }
  });
}

void BlockSolver::end_jointed(const std::vector<Body>& bodies) {
  if (joints_.empty()) return;
  for (const std::uint32_t i : uneven_) {
    starts_[i] = velocities_[i];
    IslandBody& entry = bodies_[i];
    if (entry.jointed && entry.movable)
      entry.inverse_inertia = entry.given * bodies[entry.index].world_inverse_inertia(entry.rotation);
  }
  joints_.end_step(bodies, bodies_, velocities_);
  for (const std::uint32_t i : uneven_) {
    if (!spins_.follows(i)) continue;
    set(velocities_[i].angular, spins_.turned_back(i, bodies[indices_[i]], bodies_[i].rotation, angular_of(starts_[i]),
                                                   angular_of(velocities_[i])));
  }
}

Rows BlockSolver::rows() {
  Rows rows;
  rows.blocks = contacts_.blocks.data();
  rows.pairs = contacts_.pairs;
  rows.count = contacts_.blocks.size();
  rows.balls = contacts_.balls.data();
  rows.ball_pairs = contacts_.ball_pairs;
  rows.ball_count = contacts_.balls.size();
  rows.points = contacts_.points.data();
  rows.frictions = contacts_.frictions.data();
  rows.drifts = contacts_.drifts.data();
  rows.inertias = contacts_.inertias.data();
  rows.meetings = contacts_.meetings.data();
  rows.ball_meetings = contacts_.ball_meetings.data();
  rows.velocities = velocities_.data();
  rows.displacements = displacements_.data();
  rows.lags = lags_.data();
  return rows;
}

void BlockSolver::solve(std::vector<Body>& bodies, const std::vector<Load>& loads,
                        std::span<const islands::IslandContents> islands, const Effort& effort,
                        const WorldSettings& settings, double dt, std::vector<char>& moved,
                        const threads::Workers& workers) {
  work_ = workers;
  const Kernels& kernels = fastest_kernels();
  islands::IslandContents island = islands.front();
  if (islands.size() > 1) {
    listed_.clear();
    for (const islands::IslandContents& one : islands)
      listed_.insert(listed_.end(), one.contacts.begin(), one.contacts.end());
    listed_joints_.clear();
    for (const islands::IslandContents& one : islands)
      listed_joints_.insert(listed_joints_.end(), one.joints.begin(), one.joints.end());
    island = {listed_, {}, listed_joints_};
  }
  const std::span<ContactConstraint* const> contacts = island.contacts;
  const int sub_steps = effort.sub_steps;
  const double h = dt / sub_steps;
  turned_enough_ = effort.turned_enough;
  gather(bodies, loads, islands, settings.integrator, dt);
  foresee(contacts, loads, effort.heap ? 2 * h : 0, dt);
  holds_.gather(island, bodies, places_, bodies_, driven_, h);
  if (!holds_.empty() || !island.joints.empty())
    for (std::size_t i = 1; i < bodies_.size(); ++i)
      if (bodies_[i].held || bodies_[i].jointed) paces_[i].steady = paces_[i].unturned = false;
  contacts_.build(contacts, places_, bodies_, closings_, h, work_);
  velocities_.resize(contacts_.room);
  lags_.resize(contacts_.room);
  holds_.gather(contacts_, h);
  reach_.forget();
  joints_.build(island.joints, bodies, places_, bodies_, h, dt, work_);
  spins_.begin(joints_.empty() ? 0 : bodies_.size());
  const step::Softness softness = step::soft_contacts(settings.push_out_speed, dt, sub_steps);
  const double giving = effort.giving * softness.giving;
  PassRule soft{all(softness.rate), all(softness.speed), all(1 - giving), all(1 - giving), all(1 / h), all(settled)};
  PassRule hard{.inverse_h = all(1 / h), .enough = all(settled)};
  int softening = effort.softening, relaxing = effort.relaxing;
  if (effort.single) {
    soft.passes = std::exchange(softening, 1);
    hard.passes = std::exchange(relaxing, 1);
  }
  for (int sub_step = 0; sub_step < sub_steps; ++sub_step) {
    begin_sub_step(bodies, loads, dt, sub_steps, sub_step);
    prepare_again(bodies);
    if (!led_.empty()) contacts_.ride(bodies_, led_, starts_, h);
    by_color([&](const Rows& some) { kernels.warm_start(some); });
    holds_.begin_sub_step(bodies, bodies_, velocities_, dt - (sub_step + 1) * h);
    joints_.begin_sub_step(bodies, bodies_, starts_, velocities_);
    follow_spins(bodies);
    if (bouncy_) find_rebounds(h);
    // Joints have the last word: what a contact then lacks, the next sub-step gives.
    for (int k = 0; k < softening; ++k) {
      soft.note = k + 1 == softening;
      holds_.solve(bodies, bodies_, contacts_, velocities_);
      by_color([&](const Rows& some) { kernels.solve(some, soft); });
      joints_.solve(velocities_, true, k % 2 != 0);
    }
    follow_spins(bodies);
    find_lags();
    if (!joints_.empty()) tame_jointed(bodies, h);
    joints_.move(velocities_);
    end_sub_step(h);
    end_lead();
    for (int k = 0; k < relaxing; ++k) {
      holds_.solve(bodies, bodies_, contacts_, velocities_);
      hard.sum_up = k + 1 == relaxing;
      by_color([&](const Rows& some) { kernels.solve(some, hard); });
      joints_.solve(velocities_, false, k % 2 == 0);
    }
    follow_spins(bodies);
    if (!rebounds_.empty()) {
      rebound(bodies, loads, effort.rebound_passes);
      joints_.solve(velocities_, false, true);
    }
    if (!joints_.empty()) tame_jointed(bodies, h);
    joints_.end_sub_step();
    holds_.add_up();
    bound_spins(bodies, h);
  }
  contacts_.store(h, work_);
  holds_.store();
  end_jointed(bodies);
  // Also a body that only the last pass reached has momentum from it.
  work_.ranges(contacts.size(), worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto pushed = [](const contacts::PointConstraint& point) {
        return point.total_normal > 0 || point.total_friction != Vec3::Zero();
      };
      const std::span<const contacts::PointConstraint> points = contacts[i]->points;
      const auto of_it = points.first(static_cast<std::size_t>(contacts[i]->count));
      marks_[i].pushed = std::any_of(of_it.begin(), of_it.end(), pushed);
    }
  });
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (marks_[i].pushed) paces_[contacts_.ends[i].a].touched = paces_[contacts_.ends[i].b].touched = true;
  each_body([&](std::size_t i) {
    IslandBody& entry = bodies_[i];
    if (!entry.movable || !paces_[i].touched) return;
    if (paces_[i].unturned) {
      entry.center += linear_of(displacements_[i]);
      entry.rotation = exp_map(angular_of(displacements_[i])) * entry.rotation;
      entry.rotation.normalize();
    }
    Body& body = bodies[entry.index];
    entry.rotation.coeffs() = entry.rotation.coeffs() + Vec4::Zero();
    body.center = without_sign_of_zero(entry.center);
    body.twist = {without_sign_of_zero(linear_of(velocities_[i])), without_sign_of_zero(angular_of(velocities_[i]))};
    body.saturated = entry.saturated;
    body.follow_center(entry.rotation);
    moved[entry.index] = 1;
  });
}

}  // namespace tweenfall::blocks
