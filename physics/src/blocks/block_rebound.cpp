#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "blocks/block_solver.h"
#include "islands/island_energy.h"

/// The rebound of the sub-step, contact by contact: only few take part.

namespace tweenfall::blocks {

namespace {

/// A change of velocity of this part of what counts as a tremble is left to the next sub-step.
constexpr double quiet = 0.1;

Vec3 lane_of(const Lanes3& lanes, int lane) {
  return {lanes.x[lane], lanes.y[lane], lanes.z[lane]};
}

/// The two bodies of a contact and how they are pushed.
struct Ends {
  const ContactBlock& block;
  int lane;
  const IslandBody &a, &b;
  BodyLanes &velocity_a, &velocity_b;

  [[nodiscard]] double speed(const Vec3& direction, const Vec3& turn_a, const Vec3& turn_b) const {
    return direction.dot(linear_of(velocity_b) - linear_of(velocity_a)) + turn_b.dot(angular_of(velocity_b)) -
           turn_a.dot(angular_of(velocity_a));
  }
  void push(const Vec3& impulse, const Vec3& turn_a, const Vec3& turn_b) const {
    set(velocity_a.linear, linear_of(velocity_a) - block.inverse_mass_a[lane] * impulse);
    set(velocity_a.angular, angular_of(velocity_a) - a.inverse_inertia * turn_a);
    set(velocity_b.linear, linear_of(velocity_b) + block.inverse_mass_b[lane] * impulse);
    set(velocity_b.angular, angular_of(velocity_b) + b.inverse_inertia * turn_b);
  }
};

double solve_friction(const Ends& ends, FrictionRow& row, double limit) {
  const int lane = ends.lane;
  const Vec3 along1 = lane_of(ends.block.tangent1, lane), along2 = lane_of(ends.block.tangent2, lane);
  const Vec3 first_a = lane_of(row.first_a, lane), first_b = lane_of(row.first_b, lane);
  const Vec3 second_a = lane_of(row.second_a, lane), second_b = lane_of(row.second_b, lane);
  const double slip1 = ends.speed(along1, first_a, first_b);
  const double slip2 = ends.speed(along2, second_a, second_b);
  double next1 = row.first[lane] - (row.inverse11[lane] * slip1 + row.inverse12[lane] * slip2);
  double next2 = row.second[lane] - (row.inverse12[lane] * slip1 + row.inverse22[lane] * slip2);
  if (next1 * next1 + next2 * next2 > limit * limit) {
    next1 = row.first[lane] - row.firm[lane] * slip1;
    next2 = row.second[lane] - row.firm[lane] * slip2;
    const double length = std::sqrt(next1 * next1 + next2 * next2);
    if (length > limit) {
      next1 *= limit / length;
      next2 *= limit / length;
    }
  }
  const double change1 = next1 - row.first[lane], change2 = next2 - row.second[lane];
  row.first[lane] = next1;
  row.second[lane] = next2;
  ends.push(change1 * along1 + change2 * along2, change1 * first_a + change2 * second_a,
            change1 * first_b + change2 * second_b);
  return row.firm[lane] > 0 ? std::max(std::abs(change1), std::abs(change2)) / row.firm[lane] : 0;
}

}  // namespace

void BlockSolver::find_rebounds(double h) {
  rebounds_.clear();
  meetings_.resize(contacts_.blocks.size() * lane_count);
  const std::size_t count = fastest_kernels().find_meetings(rows(), starts_.data(), h, meetings_.data());
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t index = meetings_[i] / lane_count;
    const int lane = static_cast<int>(meetings_[i] % lane_count);
    const ContactBlock& block = contacts_.blocks[index];
    const BodyLanes& a = starts_[block.a[lane]];
    const BodyLanes& b = starts_[block.b[lane]];
    const Vec3 normal = lane_of(block.normal, lane);
    step::ContactConstraint& contact = *block.contacts[lane];
    for (int k = 0; k < contact.count; ++k) {
      PointRow& row = contacts_.points[block.point + static_cast<std::uint32_t>(k)];
      const double closing = normal.dot(linear_of(a) - linear_of(b)) + lane_of(row.turn_a, lane).dot(angular_of(a)) -
                             lane_of(row.turn_b, lane).dot(angular_of(b));
      const auto [time, speed] = step::meeting_of(row.gap[lane], closing, block.pull[lane], h);
      if (!(speed > block.tremble[lane])) continue;
      step::PointConstraint& point = contact.points[static_cast<std::size_t>(k)];
      point.approach = std::max(point.approach, speed);
      const double left = h - time;
      const double back = contact.restitution * speed;
      const double speed_at_end = back - block.pull[lane] * left;
      if (back <= 0 || speed_at_end <= 0) continue;
      row.rebound[lane] = speed_at_end;
      rebounds_.push_back({index, block.point + static_cast<std::uint32_t>(k), lane,
                           left * (back - 0.5 * block.pull[lane] * left) / speed_at_end});
    }
  }
}

void BlockSolver::remember(std::uint32_t index, int lane) {
  char& known = remembered_[index * lane_count + static_cast<std::uint32_t>(lane)];
  if (known) return;
  known = 1;
  const ContactBlock& block = contacts_.blocks[index];
  for (const std::uint32_t place : {block.a[lane], block.b[lane]}) {
    if (known_before_[place]) continue;
    known_before_[place] = 1;
    before_rebound_[place] = velocities_[place];
  }
  Reached& reached = reached_.emplace_back();
  reached.block = index;
  reached.lane = lane;
  for (int k = 0; k < block.points; ++k)
    reached.normal[k] = contacts_.points[block.point + static_cast<std::uint32_t>(k)].impulse[lane];
  for (int k = 0; k < block.frictions; ++k) {
    const FrictionRow& row = contacts_.frictions[block.friction + static_cast<std::uint32_t>(k)];
    reached.first[k] = row.first[lane];
    reached.second[k] = row.second[lane];
  }
}

double BlockSolver::rebound_contact(std::uint32_t index, int lane) {
  const ContactBlock& block = contacts_.blocks[index];
  const IslandBody& a = bodies_[block.a[lane]];
  const IslandBody& b = bodies_[block.b[lane]];
  remember(index, lane);
  const Ends ends{block, lane, a, b, velocities_[block.a[lane]], velocities_[block.b[lane]]};
  const Vec3 normal = lane_of(block.normal, lane);
  const step::ContactConstraint& contact = *block.contacts[lane];
  double change = 0;
  double pressing = 0;
  for (int k = 0; k < contact.count; ++k)
    pressing += contacts_.points[block.point + static_cast<std::uint32_t>(k)].impulse[lane];
  if (contact.impact)
    for (int k = 0; k < std::min(block.frictions, block.central() ? 1 : contact.count); ++k) {
      const double normal_impulse =
          block.central() ? pressing : contacts_.points[block.point + static_cast<std::uint32_t>(k)].impulse[lane];
      change =
          std::max(change, solve_friction(ends, contacts_.frictions[block.friction + static_cast<std::uint32_t>(k)],
                                          contact.friction * normal_impulse));
    }
  for (int k = 0; k < contact.count; ++k) {
    PointRow& row = contacts_.points[block.point + static_cast<std::uint32_t>(k)];
    if (row.impulse[lane] == 0 && row.gap[lane] > 0) continue;
    const Vec3 turn_a = lane_of(row.turn_a, lane), turn_b = lane_of(row.turn_b, lane);
    const double speed = ends.speed(normal, turn_a, turn_b);
    const double next = std::max(0.0, row.impulse[lane] - row.mass[lane] * (speed - row.rebound[lane]));
    const double pushed = next - row.impulse[lane];
    if (pushed == 0) continue;
    row.impulse[lane] = next;
    ends.push(pushed * normal, pushed * turn_a, pushed * turn_b);
    change = std::max(change, std::abs(pushed) / row.mass[lane]);
  }
  if (change > quiet * block.tremble[lane]) {
    if (a.movable) reach_.stir(block.a[lane]);
    if (b.movable) reach_.stir(block.b[lane]);
  }
  return change / block.tremble[lane];
}

/// See Solver::move_by_rebound.
void BlockSolver::move_by(const Rebound& rebound) {
  const ContactBlock& block = contacts_.blocks[rebound.block];
  const PointRow& row = contacts_.points[rebound.row];
  const int lane = rebound.lane;
  const double part = row.rebound[lane] / (row.rebound[lane] - std::min(0.0, rebound.speed_before));
  const double most = row.mass[lane] * row.rebound[lane];
  const double own = std::clamp((row.impulse[lane] - rebound.impulse_before) * part, -most, most) * rebound.time;
  if (own == 0) return;
  const auto move = [&](std::uint32_t place, double by, const Vec3& turn) {
    IslandBody& body = bodies_[place];
    if (!body.movable) return;
    const Vec3 moved = body.inverse_mass * by * lane_of(block.normal, lane);
    const Vec3 turning = body.inverse_inertia * (by * turn);
    body.center += moved;
    BodyLanes& displacement = displacements_[place];
    for (int i = 0; i < 3; ++i) {
      displacement.linear[i] += moved[i];
      displacement.angular[i] += turning[i];
    }
    if (turning == Vec3::Zero()) return;
    if (!body.round) body.turned += turning.norm();
    body.rotation = exp_map(turning) * body.rotation;
    body.rotation.normalize();
  };
  move(block.a[lane], -own, lane_of(row.turn_a, lane));
  move(block.b[lane], own, lane_of(row.turn_b, lane));
}

/// Takes back as much of the rebound as would leave the island more energy than it had and than was put into it.
void BlockSolver::bound_energy(const std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads) {
  islands::IslandEnergy energy;
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    const IslandBody& entry = bodies_[i];
    if (!entry.movable) continue;
    const BodyLanes& before = known_before_[i] ? before_rebound_[i] : velocities_[i];
    if (entry.even) {
      energy.add(entry.mass, entry.moment, {linear_of(starts_[i]), angular_of(starts_[i])},
                 {linear_of(before), angular_of(before)}, {linear_of(velocities_[i]), angular_of(velocities_[i])},
                 entry.mass * entry.acceleration.dot(entry.center - entry.sub_step_center));
      continue;
    }
    islands::BodyCourse course;
    course.start = {linear_of(starts_[i]), angular_of(starts_[i])};
    course.start_center = entry.sub_step_center;
    course.start_rotation = entry.sub_step_rotation;
    course.before = {linear_of(before), angular_of(before)};
    course.after = {linear_of(velocities_[i]), angular_of(velocities_[i])};
    course.center = entry.center;
    course.rotation = entry.rotation;
    energy.add(bodies[entry.index], loads[entry.index], course);
  }
  // What moves by its own will does work on what it pushes.
  for (const ContactBlock& block : contacts_.blocks)
    for (int lane = 0; lane < lane_count; ++lane) {
      if (!block.contacts[lane] || bodies_[block.a[lane]].movable == bodies_[block.b[lane]].movable) continue;
      const bool a_moves = bodies_[block.a[lane]].movable;
      const BodyLanes& will = velocities_[a_moves ? block.b[lane] : block.a[lane]];
      const Vec3 linear = linear_of(will), angular = angular_of(will);
      if (linear == Vec3::Zero() && angular == Vec3::Zero()) continue;
      const auto work = [&](double impulse, const Vec3& direction, const Lanes3& turn) {
        energy.limit += (a_moves ? -impulse : impulse) * (direction.dot(linear) + lane_of(turn, lane).dot(angular));
      };
      for (int k = 0; k < block.points; ++k) {
        const PointRow& row = contacts_.points[block.point + static_cast<std::uint32_t>(k)];
        work(row.impulse[lane], lane_of(block.normal, lane), a_moves ? row.turn_b : row.turn_a);
      }
      for (int k = 0; k < block.frictions; ++k) {
        const FrictionRow& row = contacts_.frictions[block.friction + static_cast<std::uint32_t>(k)];
        work(row.first[lane], lane_of(block.tangent1, lane), a_moves ? row.first_b : row.first_a);
        work(row.second[lane], lane_of(block.tangent2, lane), a_moves ? row.second_b : row.second_a);
      }
      energy.limit += (a_moves ? -1 : 1) * block.twist[lane] * lane_of(block.normal, lane).dot(angular);
    }
  const double share = energy.share_within();
  if (share == 1) return;
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    if (!bodies_[i].movable || !known_before_[i]) continue;
    const auto back = [share](double(&lanes)[4], const double(&before)[4]) {
      for (int k = 0; k < 3; ++k) lanes[k] = before[k] + share * (lanes[k] - before[k]);
    };
    back(velocities_[i].linear, before_rebound_[i].linear);
    back(velocities_[i].angular, before_rebound_[i].angular);
  }
  for (const Reached& reached : reached_) {
    const ContactBlock& block = contacts_.blocks[reached.block];
    const int lane = reached.lane;
    const auto back = [share, lane](Lanes& lanes, double before) {
      lanes[lane] = before + share * (lanes[lane] - before);
    };
    for (int k = 0; k < block.points; ++k)
      back(contacts_.points[block.point + static_cast<std::uint32_t>(k)].impulse, reached.normal[k]);
    for (int k = 0; k < block.frictions; ++k) {
      FrictionRow& row = contacts_.frictions[block.friction + static_cast<std::uint32_t>(k)];
      back(row.first, reached.first[k]);
      back(row.second, reached.second[k]);
    }
  }
}

/// Adds what the rebound gave to the totals. A blow says nothing about the forces after it: the next sub-step begins
/// with the impulses from before the rebound, and with none where something bounced off.
void BlockSolver::end_rebound() {
  for (const Reached& reached : reached_) {
    const ContactBlock& block = contacts_.blocks[reached.block];
    const int lane = reached.lane;
    const auto hand_on = [lane](Lanes& total, Lanes& impulse, double before) {
      total[lane] += impulse[lane] - before;
      impulse[lane] = before;
    };
    for (int k = 0; k < block.points; ++k) {
      PointRow& row = contacts_.points[block.point + static_cast<std::uint32_t>(k)];
      hand_on(row.total, row.impulse, reached.normal[k]);
      if (row.rebound[lane] > 0) row.impulse[lane] = 0;
    }
    for (int k = 0; k < block.frictions; ++k) {
      FrictionRow& row = contacts_.frictions[block.friction + static_cast<std::uint32_t>(k)];
      hand_on(row.total_first, row.first, reached.first[k]);
      hand_on(row.total_second, row.second, reached.second[k]);
    }
    remembered_[reached.block * lane_count + static_cast<std::uint32_t>(lane)] = 0;
  }
  reached_.clear();
}

void BlockSolver::rebound(const std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads, int passes) {
  const bool any = std::any_of(rebounds_.begin(), rebounds_.end(), [this](const Rebound& rebound) {
    return contacts_.points[rebound.row].impulse[rebound.lane] > 0;
  });
  if (any) {
    before_rebound_.resize(bodies_.size());
    known_before_.assign(bodies_.size(), 0);
    reach_.begin(contacts_.blocks, bodies_);
    remembered_.resize(contacts_.blocks.size() * lane_count, 0);
    for (Rebound& rebound : rebounds_) {
      const ContactBlock& block = contacts_.blocks[rebound.block];
      const PointRow& row = contacts_.points[rebound.row];
      IslandBody& a = bodies_[block.a[rebound.lane]];
      IslandBody& b = bodies_[block.b[rebound.lane]];
      const Ends ends{
          block, rebound.lane, a, b, velocities_[block.a[rebound.lane]], velocities_[block.b[rebound.lane]]};
      rebound.speed_before = ends.speed(lane_of(block.normal, rebound.lane), lane_of(row.turn_a, rebound.lane),
                                        lane_of(row.turn_b, rebound.lane));
      rebound.impulse_before = row.impulse[rebound.lane];
      if (!(row.impulse[rebound.lane] > 0)) continue;
      if (a.movable) reach_.stir(block.a[rebound.lane]);
      if (b.movable) reach_.stir(block.b[rebound.lane]);
    }
    for (int pass = 0; pass < passes; ++pass) {
      double most = 0;
      reach_.visit([&](std::uint32_t lane) {
        most = std::max(most, rebound_contact(lane / lane_count, static_cast<int>(lane % lane_count)));
      });
      if (most < quiet) break;
    }
    for (const Rebound& rebound : rebounds_) move_by(rebound);
    bound_energy(bodies, loads);
    end_rebound();
  }
  for (const Rebound& rebound : rebounds_) contacts_.points[rebound.row].rebound[rebound.lane] = 0;
}

}  // namespace tweenfall::blocks
