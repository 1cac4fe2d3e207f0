#include "islands/blocks/block_solver.h"

#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <utility>

#include "step/softness.h"

namespace tweenfall::blocks {

using contacts::ContactConstraint;
using forces::Load;
using state::Body;

namespace {

constexpr BodyLag pressed_still = {{0, 0, 0, 1}};

/// Passes that a heap needs in addition to hand on what springs back in it.
constexpr int passes_of_rebounds = 2;

}  // namespace

/// Where a contact holds a body, the velocity after the impulses counts: a mean would leave all jitter undamped.
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

/// Bodies held only by joints fly as one: their center of mass has the mean velocity, and nothing else is free to
/// jitter. If they hang on something, they are held as by a contact. A slack joint holds nothing.
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

/// Joints and motors that contradict each other may ask for any speed. A body that would turn or move farther in a
/// sub-step than can be followed keeps the velocity that it had, and its joints forget what they asked for. Where they
/// only turned it too far, and hang on nothing, all of them take over the momentum that this would cost.
void BlockSolver::tame_jointed(const std::vector<Body>& bodies, double h) {
  constexpr double farthest_turn = 2;  // rad
  constexpr double farthest = 100;     // of the body's size
  const auto moves_near = [&](std::size_t i) {
    const double gained = (linear_of(velocities_[i]) - linear_of(starts_[i])).squaredNorm() * h * h;
    const double reach = farthest * bodies[bodies_[i].index].radius();
    return gained <= reach * reach;
  };
  const auto is_wild = [&](std::size_t i) {
    if (!bodies_[i].jointed || !bodies_[i].movable) return false;
    return !(moves_near(i) && angular_of(velocities_[i]).squaredNorm() * h * h <= farthest_turn * farthest_turn);
  };
  wild_.assign(work_.range_count(bodies_.size() - 1, worth_a_part), 0);
  work_.numbered_ranges(bodies_.size() - 1, worth_a_part, [&](std::size_t part, std::size_t begin, std::size_t end) {
    bool some = false;
    for (std::size_t i = begin + 1; i < end + 1 && !some; ++i) some = is_wild(i);
    wild_[part] = some ? 1 : 0;
  });
  if (std::find(wild_.begin(), wild_.end(), 1) == wild_.end()) return;
  jointed_.assign(island_of_.back() + std::size_t{1}, {});
  joints_.find_held(bodies_, [this](std::uint32_t place) { jointed_[island_of_[place]].free = false; });
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    if (!bodies_[i].jointed || !bodies_[i].movable) continue;
    JointedFlight& its = jointed_[island_of_[i]];
    its.mass += paces_[i].mass;
    if (!is_wild(i)) continue;
    its.wild = true;
    its.free = its.free && moves_near(i);
    BodyLanes& velocity = velocities_[i];
    its.gained += paces_[i].mass * (linear_of(velocity) - linear_of(starts_[i]));
    velocity = starts_[i];
    Vec3 angular = angular_of(velocity);
    const double turn = angular.norm() * h;
    if (turn > farthest_turn) set(velocity.angular, angular * (0.5 * farthest_turn / turn));
  }
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    const JointedFlight& its = jointed_[island_of_[i]];
    if (its.wild && its.free && bodies_[i].jointed && bodies_[i].movable)
      set(velocities_[i].linear, linear_of(velocities_[i]) + its.gained / its.mass);
  }
  joints_.forget([this](std::uint32_t place) { return jointed_[island_of_[place]].wild; });
}

/// What impulses gave to the spins of jointed bodies turns along with them. Most of it is known when the rows begin;
/// joints see the rest in the next sub-step.
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
  rows.origins = contacts_.origins.data();
  rows.bodies = bodies_.data();
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
  foresee(contacts, loads, effort.heap ? 2 * h * parts_ : 0, dt);
  holds_.gather(island, bodies, places_, bodies_, driven_, h);
  // Whoever rides on a led body is looked at in every sub-step.
  if (!holds_.empty() || !island.joints.empty() || !led_.empty())
    for (std::size_t i = 1; i < bodies_.size(); ++i)
      if (bodies_[i].held || bodies_[i].jointed || !led_.empty()) paces_[i].steady = paces_[i].unturned = false;
  contacts_.build(contacts, places_, bodies_, closings_, h, work_);
  velocities_.resize(contacts_.room);
  lags_.resize(contacts_.room);
  each_block([&](const Rows& some) { kernels.prepare(some); });
  contacts_.prepare_drifts(bodies_, false);
  holds_.gather(contacts_, rolls_, h);
  reach_.forget();
  joints_.build(island.joints, bodies, places_, bodies_, h, dt, work_);
  spins_.begin(joints_.empty() ? 0 : bodies_.size());
  const step::Softness softness = step::soft_contacts(settings.push_out_speed, dt, sub_steps, parts_);
  const double giving = effort.giving * softness.giving;
  PassRule soft{all(softness.rate), all(softness.speed), all(1 - giving),
                all(1 - giving),    all(1 / h),          all(effort.settled)};
  PassRule hard{.inverse_h = all(1 / h), .enough = all(effort.settled)};
  int softening = effort.softening, relaxing = effort.relaxing;
  if (effort.single) {
    soft.passes = std::exchange(softening, 1);
    hard.passes = std::exchange(relaxing, 1);
  }
  // In a heap something strikes every figure all the time.
  const bool passes_on = !joints_.empty() && !effort.heap;
  for (int sub_step = 0; sub_step < sub_steps; ++sub_step) {
    begin_sub_step(bodies, loads, dt, sub_steps, sub_step);
    prepare_again(bodies);
    if (!led_.empty()) contacts_.ride(bodies_, led_, starts_, h);
    if (!carries_on_) by_color([&](const Rows& some) { kernels.warm_start(some); });
    holds_.begin_sub_step(bodies, bodies_, velocities_, dt - (sub_step + 1) * h);
    joints_.begin_sub_step(bodies, bodies_, starts_, velocities_);
    follow_spins(bodies);
    const bool blows = passes_on && meets_;
    if (bouncy_ || blows) find_meetings(h);
    // Joints have the last word: what a contact then lacks, the next sub-step supplies.
    for (int k = 0; k < softening; ++k) {
      soft.measures = k == 0 && !(bouncy_ || blows);
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
    const bool springs = bouncy_ && springs_back_dully();
    const int passes = relaxing + (springs && effort.heap ? passes_of_rebounds : 0);
    for (int k = 0; k < passes; ++k) {
      holds_.solve(bodies, bodies_, contacts_, velocities_);
      hard.sum_up = k + 1 == passes;
      hard.springs = springs;
      by_color([&](const Rows& some) { kernels.solve(some, hard); });
      joints_.solve(velocities_, false, k % 2 == 0);
    }
    rebounded_ = springs || !rebounds_.empty();
    if (rebounded_)
      each_body([this](std::size_t i) { ended_[i] = velocities_[i]; });
    else
      for (const std::uint32_t i : uneven_) ended_[i] = velocities_[i];
    follow_spins(bodies);
    carry_spins(h);
    if (springs) end_dull_rebounds();
    if (!rebounds_.empty()) {
      rebound(bodies, loads, effort.rebound_passes);
      joints_.solve(velocities_, false, true);
    }
    if (!joints_.empty()) tame_jointed(bodies, h);
    // A rope that only the last pass tightened also pulled at both ends.
    joints_.each_acting([this](std::uint32_t a, std::uint32_t b) { paces_[a].touched = paces_[b].touched = true; });
    if (!joints_.empty()) end_blows(blows);
    holds_.add_up();
    bound_spins(bodies, h);
  }
  contacts_.store(h, dt, parts_, work_);
  holds_.store();
  end_jointed(bodies);
  // A body that only the last pass reached also got momentum from it.
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
    if (paces_[i].steady) entry.center += linear_of(displacements_[i]);
    if (paces_[i].unturned) {
      entry.rotation = exp_map(angular_of(displacements_[i])) * entry.rotation;
      entry.rotation.normalize();
    }
    include_turn(i);
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
