#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "contacts/combine.h"
#include "islands/blocks/block_solver.h"
#include "islands/island_energy.h"

/// The rebound of the sub-step, contact by contact: only few take part.

namespace tweenfall::blocks {

namespace {

/// A change of velocity below this part of the jitter is left to the next sub-step.
constexpr double quiet = 0.1;
/// What comes back more slowly than this part of the jitter cannot be told from it.
constexpr double hardly_back = 0.25;
/// Share of a blow with which its contact begins the next sub-step, if joints passed it on.
constexpr double kept_of_blow = 0.5;

double dot(const double (&a)[4], const double (&b)[4]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

bool same(const BodyLanes& a, const BodyLanes& b) {
  return std::memcmp(&a, &b, sizeof(BodyLanes)) == 0;
}

double kinetic(const BodyPace& pace, const BodyLanes& velocity) {
  return 0.5 *
         (pace.mass * dot(velocity.linear, velocity.linear) + pace.moment * dot(velocity.angular, velocity.angular));
}

}  // namespace

void BlockSolver::find_meetings(double h) {
  const Rows all = rows();
  const std::size_t blocks = contacts_.blocks.size();
  meetings_.resize(contacts_.size() * lane_count);
  meeting_parts_.resize(std::max(meeting_parts_.size(), work_.range_count(contacts_.size(), blocks_worth_a_part)));
  for (Meetings& part : meeting_parts_) {
    part.lively.clear();
    part.dull.clear();
    part.blows.clear();
  }
  work_.numbered_ranges(
      contacts_.size(), blocks_worth_a_part, [&](std::size_t part, std::size_t begin, std::size_t end) {
        if (begin < blocks)
          find_meetings(part_of(all, false, begin, std::min(end, blocks)), begin, h, meeting_parts_[part]);
        const std::size_t first = std::max(begin, blocks);
        if (first < end)
          find_meetings(part_of(all, true, first - blocks, end - blocks), first, h, meeting_parts_[part]);
      });
  rebounds_.clear();
  for (const Meetings& part : meeting_parts_) rebounds_.insert(rebounds_.end(), part.lively.begin(), part.lively.end());
}

/// @param first  how many blocks and balls come before these rows
void BlockSolver::find_meetings(const Rows& rows, std::size_t first, double h, Meetings& found) {
  std::uint32_t* meetings = meetings_.data() + first * lane_count;
  const std::size_t count = fastest_kernels().find_meetings(rows, starts_.data(), h, meetings);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t at = meetings[i] + static_cast<std::uint32_t>(first * lane_count);
    const std::size_t index = at / lane_count;
    const int lane = static_cast<int>(at % lane_count);
    contacts::ContactConstraint& contact = *contacts_.origin(index)[static_cast<std::size_t>(lane)];
    const bool ball = index >= contacts_.blocks.size();
    const std::size_t ball_index = index - contacts_.blocks.size();
    const MeetingRow& meeting = ball ? contacts_.ball_meetings[ball_index] : contacts_.meetings[index];
    const std::uint32_t end_a = ball ? contacts_.balls[ball_index].a[lane] : contacts_.blocks[index].a[lane];
    const std::uint32_t end_b = ball ? contacts_.balls[ball_index].b[lane] : contacts_.blocks[index].b[lane];
    const bool jointed = contact.impact && (bodies_[end_a].jointed || bodies_[end_b].jointed);
    const auto meet = [&](std::uint32_t k, double closing, double gap) {
      const auto [time, speed] = contacts::meeting_of(gap, closing, meeting.pull[lane], h);
      if (!(speed > meeting.tremble[lane])) return;
      contacts::PointConstraint& point = contact.points[k];
      point.approach = std::max(point.approach, speed);
      if (jointed) found.blows.push_back({at, k});
      const double left = h - time;
      const double back = contact.restitution * speed;
      const double speed_at_end = back - meeting.pull[lane] * left;
      if (back <= hardly_back * meeting.tremble[lane] || speed_at_end <= 0) return;
      if (contact.restitution > contacts::dull) {
        found.lively.push_back({at, k, speed_at_end, left * (back - 0.5 * meeting.pull[lane] * left) / speed_at_end});
        return;
      }
      found.dull.push_back({at, k});
      if (ball) {
        contacts_.balls[ball_index].back[lane] = speed_at_end;
      } else {
        ContactBlock& block = contacts_.blocks[index];
        block.springs = true;
        contacts_.points[block.point + k].back[lane] = speed_at_end;
      }
    };
    if (ball) {
      const BallBlock& block = contacts_.balls[ball_index];
      meet(0, lane_of(block.normal, lane).dot(linear_of(starts_[block.a[lane]]) - linear_of(starts_[block.b[lane]])),
           block.gap[lane]);
      continue;
    }
    const ContactBlock& block = contacts_.blocks[index];
    const BodyLanes& a = starts_[block.a[lane]];
    const BodyLanes& b = starts_[block.b[lane]];
    const double along = lane_of(block.normal, lane).dot(linear_of(a) - linear_of(b));
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(contact.count); ++k) {
      const PointRow& row = contacts_.points[block.point + k];
      meet(k, along + lane_of(row.turn_a, lane).dot(angular_of(a)) - lane_of(row.turn_b, lane).dot(angular_of(b)),
           row.gap[lane]);
    }
  }
}

bool BlockSolver::springs_back_dully() const {
  return std::ranges::any_of(meeting_parts_, [](const Meetings& part) { return !part.dull.empty(); });
}

/// Starts the next sub-step of this point with a share of its impulse.
void BlockSolver::start_anew(const MeetingPoint& one, double share) {
  const std::size_t index = one.lane / lane_count;
  const int lane = static_cast<int>(one.lane % lane_count);
  const auto let_go = [this](std::uint32_t place, const Vec3& impulse, const Vec3& turn) {
    if (!bodies_[place].movable) return;
    add(ended_[place].linear, bodies_[place].inverse_mass * impulse);
    add(ended_[place].angular, bodies_[place].inverse_inertia * turn);
  };
  if (index >= contacts_.blocks.size()) {
    BallBlock& ball = contacts_.balls[index - contacts_.blocks.size()];
    const Vec3 gone = (1 - share) * ball.impulse[lane] * lane_of(ball.normal, lane);
    let_go(ball.a[lane], gone, Vec3::Zero());
    let_go(ball.b[lane], -gone, Vec3::Zero());
    ball.impulse[lane] *= share;
    ball.back[lane] = 0;
    return;
  }
  ContactBlock& block = contacts_.blocks[index];
  PointRow& row = contacts_.points[block.point + one.point];
  const double gone = (1 - share) * row.impulse[lane];
  const Vec3 normal = lane_of(block.normal, lane);
  let_go(block.a[lane], gone * normal, gone * lane_of(row.turn_a, lane));
  let_go(block.b[lane], -gone * normal, -gone * lane_of(row.turn_b, lane));
  row.impulse[lane] *= share;
  row.back[lane] = 0;
  block.springs = false;
}

void BlockSolver::end_dull_rebounds() {
  for (const Meetings& part : meeting_parts_)
    for (const MeetingPoint& one : part.dull) start_anew(one, 0);
}

/// A blow says little about the forces after it. If joints that passed it on began the next sub-step with all of it,
/// the passes would not take it back, and bodies would leave the ground with energy that they never had.
void BlockSolver::end_blows(bool any) {
  if (!any) return joints_.end_sub_step([](std::uint32_t) { return false; });
  struck_.assign(bodies_.size(), 0);
  for (const Meetings& part : meeting_parts_)
    for (const MeetingPoint& one : part.blows) {
      const std::size_t index = one.lane / lane_count, lane = one.lane % lane_count;
      const bool ball = index >= contacts_.blocks.size();
      const std::size_t ball_index = index - contacts_.blocks.size();
      struck_[ball ? contacts_.balls[ball_index].a[lane] : contacts_.blocks[index].a[lane]] = 1;
      struck_[ball ? contacts_.balls[ball_index].b[lane] : contacts_.blocks[index].b[lane]] = 1;
      start_anew(one, kept_of_blow);
    }
  joints_.end_sub_step([&](std::uint32_t place) { return struck_[place] != 0 && bodies_[place].movable; });
}

/// See Solver::move_by_rebound.
/// @return whether the rows of a body must be prepared again
template <class Contact>
bool BlockSolver::move_by(const Rebound& rebound, const Contact& contact) {
  const double part = rebound.speed / (rebound.speed - std::min(0.0, rebound.speed_before));
  const double most = contact.mass(rebound.point) * rebound.speed;
  const double own = std::clamp(contact.given(rebound.point) * part, -most, most) * rebound.time;
  bool stale = false;
  if (own == 0) return stale;
  const auto move = [&](std::uint32_t place, double by, const Vec3& turn) {
    IslandBody& body = bodies_[place];
    if (!body.movable) return;
    const Vec3 moved = body.inverse_mass * by * contact.normal();
    BodyLanes& displacement = displacements_[place];
    for (int i = 0; i < 3; ++i) displacement.linear[i] += moved[i];
    if (paces_[place].unturned) return;
    if (paces_[place].steady)
      include_turn(place);
    else
      body.center += moved;
    const Vec3 turning = body.inverse_inertia * (by * turn);
    if (turning == Vec3::Zero()) return;
    for (int i = 0; i < 3; ++i) displacement.angular[i] += turning[i];
    double& turned = turns_[place].turned;
    if (!body.round) turned += turning.norm();
    // Its rows are prepared again, whether or not another body that is solved at the same time turns.
    stale = stale || turned > turned_enough_;
    body.rotation = exp_map(turning) * body.rotation;
    body.rotation.normalize();
  };
  move(contact.a(), -own, contact.turn_a(rebound.point));
  move(contact.b(), own, contact.turn_b(rebound.point));
  return stale;
}

/// Work of bodies that move by their own will on what they push, J.
double BlockSolver::work_of_driven() const {
  double sum = 0;
  for (std::size_t i = contacts_.pairs; i < contacts_.blocks.size(); ++i)
    for (int lane = 0; lane < lane_count; ++lane) {
      const ContactBlock& block = contacts_.blocks[i];
      const std::uint32_t a = block.a[lane], b = block.b[lane];
      if (!contacts_.origins[i][static_cast<std::size_t>(lane)] || bodies_[a].movable == bodies_[b].movable) continue;
      const bool a_moves = bodies_[a].movable;
      const IslandBody& driven = bodies_[a_moves ? b : a];
      if (driven.led == step::not_led) continue;
      const BodyLanes& will = velocities_[a_moves ? b : a];
      const Vec3 linear = linear_of(will), angular = angular_of(will);
      const auto work = [&](double impulse, const Vec3& direction, const Lanes3& turn) {
        sum += (a_moves ? -impulse : impulse) * (direction.dot(linear) + lane_of(turn, lane).dot(angular));
      };
      for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(block.points); ++k) {
        const PointRow& row = contacts_.points[block.point + k];
        work(row.impulse[lane], lane_of(block.normal, lane), a_moves ? row.turn_b : row.turn_a);
      }
      for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(block.frictions); ++k) {
        const FrictionRow& row = contacts_.frictions[block.friction + k];
        work(row.first[lane], lane_of(block.tangent1, lane), a_moves ? row.first_b : row.first_a);
        work(row.second[lane], lane_of(block.tangent2, lane), a_moves ? row.second_b : row.second_a);
      }
      sum += (a_moves ? -1 : 1) * block.twist[lane] * lane_of(block.normal, lane).dot(angular);
    }
  return sum;
}

/// Takes back as much of the rebound as would leave an island with more energy than it had and was given.
void BlockSolver::bound_energy(const std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads) {
  // The work of a surface is not known: the island is left as it is.
  if (conveyed_) return;
  energies_.assign(island_of_.back() + std::size_t{1}, {});
  // An island in which nothing was changed has what it had.
  reached_.assign(energies_.size(), 0);
  changed_.resize(bodies_.size());
  each_body([&](std::size_t i) { changed_[i] = paces_[i].movable && !same(reach_.before(i), velocities_[i]); });
  for (std::size_t i = 1; i < bodies_.size(); ++i)
    if (changed_[i] != 0) reached_[island_of_[i]] = 1;
  // Each by itself, and then added up in order.
  even_energies_.resize(bodies_.size());
  each_body([&](std::size_t i) {
    const BodyPace& pace = paces_[i];
    if (!pace.movable || !pace.even || reached_[island_of_[i]] == 0) return;
    islands::IslandEnergy& energy = even_energies_[i];
    const BodyLanes& before = reach_.before(i);
    double moved[4];
    for (int k = 0; k < 4; ++k) moved[k] = displacements_[i].linear[k] - sub_starts_[i].lanes[k];
    energy.limit = kinetic(pace, starts_[i]) + pace.mass * dot(pace.acceleration, moved);
    energy.without = kinetic(pace, before);
    energy.slope = energy.curvature = 0;
    if (changed_[i] == 0) return;
    BodyLanes change;
    for (int k = 0; k < 4; ++k) {
      change.linear[k] = velocities_[i].linear[k] - before.linear[k];
      change.angular[k] = velocities_[i].angular[k] - before.angular[k];
    }
    energy.slope = pace.mass * dot(change.linear, before.linear) + pace.moment * dot(change.angular, before.angular);
    energy.curvature = kinetic(pace, change);
  });
  for (std::uint32_t i = 1; i < bodies_.size(); ++i) {
    const BodyPace& pace = paces_[i];
    if (!pace.movable || reached_[island_of_[i]] == 0) continue;
    islands::IslandEnergy& energy = energies_[island_of_[i]];
    if (pace.even) {
      const islands::IslandEnergy& own = even_energies_[i];
      energy.limit += own.limit;
      energy.without += own.without;
      energy.slope += own.slope;
      energy.curvature += own.curvature;
      continue;
    }
    const BodyLanes& before = reach_.before(i);
    const IslandBody& entry = bodies_[i];
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
  // Bodies that move by their own will are in islands that are solved alone.
  if (!led_.empty()) {
    islands::IslandEnergy& energy = energies_.front();
    energy.limit += work_of_driven();
    for (const ReboundContact& contact : reach_.contacts()) {
      const bool a_moves = bodies_[contact.a()].movable;
      const std::uint32_t driven = a_moves ? contact.b() : contact.a();
      if (!bodies_[driven].movable) energy.limit += contact.work(velocities_[driven], a_moves);
    }
  }
  shares_.clear();
  shares_.reserve(energies_.size());
  for (const islands::IslandEnergy& energy : energies_) shares_.push_back(energy.share_within());
  each_body([&](std::size_t i) {
    const double share = shares_[island_of_[i]];
    if (share == 1 || changed_[i] == 0) return;
    const BodyLanes& before = reach_.before(i);
    const auto back = [share](double(&lanes)[4], const double(&start)[4]) {
      for (int k = 0; k < 3; ++k) lanes[k] = start[k] + share * (lanes[k] - start[k]);
    };
    back(velocities_[i].linear, before.linear);
    back(velocities_[i].angular, before.angular);
  });
  const auto take_back = [this](auto& contact) {
    const double share = shares_[island_of_[bodies_[contact.a()].movable ? contact.a() : contact.b()]];
    if (share != 1) contact.take_back(share);
  };
  std::ranges::for_each(reach_.contacts(), take_back);
  std::ranges::for_each(reach_.balls(), take_back);
}

/// Calls see(first, behind, part) for parts of the rebounds of one color after the other; those of one contact stay
/// together.
template <class See>
void BlockSolver::each_rebound(const See& see) {
  std::size_t first = 0;
  for (const ContactBlocks::Stretch& stretch : contacts_.stretches) {
    std::size_t behind = first;
    while (behind < rebounds_.size() && rebounds_[behind].lane < stretch.end) ++behind;
    const auto whole = [this, first, behind](std::size_t at) {
      while (at > first && at < behind && rebounds_[at].lane == rebounds_[at - 1].lane) ++at;
      return at;
    };
    work_.numbered_ranges(behind - first, rebounds_worth_a_part,
                          [&](std::size_t part, std::size_t begin, std::size_t end) {
                            see(whole(first + begin), whole(first + end), part);
                          });
    first = behind;
  }
}

void BlockSolver::rebound(const std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads, int passes) {
  const auto pressed = [this](const Rebound& rebound) { return contacts_.impulse(rebound.lane, rebound.point) > 0; };
  if (std::none_of(rebounds_.begin(), rebounds_.end(), pressed)) return;
  const bool shared = work_.threads() > 1;
  reach_.begin(contacts_, bodies_, velocities_);
  meetings_.clear();
  for (const Rebound& rebound : rebounds_)
    if (meetings_.empty() || meetings_.back() != rebound.lane) meetings_.push_back(rebound.lane);
  reach_.reach(meetings_);
  each_rebound([&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) {
      Rebound& rebound = rebounds_[i];
      if (i == begin || rebounds_[i - 1].lane != rebound.lane) reach_.take(rebound.lane, contacts_, bodies_);
      rebound.speed_before = reach_.with(rebound.lane, [&](auto& contact) {
        contact.want(rebound.point, rebound.speed);
        return contact.speed(rebound.point, velocities_);
      });
      if (pressed(rebound)) reach_.look_at(rebound.lane, shared);
    }
  });
  // Contacts of one color push no body of each other: they are visited in any order, or at once.
  for (int pass = 0; pass < passes; ++pass) {
    bool any = false;
    for (const ContactBlocks::Stretch& stretch : contacts_.stretches) {
      const std::span<const std::uint32_t> due = reach_.due(stretch);
      if (due.empty()) continue;
      any = true;
      reach_.reach(due);
      work_.ranges(due.size(), rebounds_worth_a_part, [&](std::size_t begin, std::size_t end) {
        for (const std::uint32_t lane : due.subspan(begin, end - begin)) {
          reach_.take(lane, contacts_, bodies_);
          reach_.with(lane, [&](auto& contact) {
            // If it passes a push on, its neighbors must be visited, too.
            if (contact.solve(velocities_) > quiet * contact.tremble())
              for (const std::uint32_t place : {contact.a(), contact.b()})
                if (bodies_[place].movable) reach_.push(place, lane, shared);
          });
        }
      });
    }
    if (!any) break;
  }
  stale_.assign(work_.range_count(rebounds_.size(), rebounds_worth_a_part), 0);
  each_rebound([&](std::size_t begin, std::size_t end, std::size_t part) {
    for (const Rebound& rebound : std::span(rebounds_).subspan(begin, end - begin))
      if (reach_.with(rebound.lane, [&](const auto& contact) { return move_by(rebound, contact); })) stale_[part] = 1;
  });
  for (const char stale : stale_) any_stale_ = any_stale_ || stale != 0;
  bound_energy(bodies, loads);
  const auto put_back = [this](const auto& contacts) {
    work_.ranges(contacts.size(), rebounds_worth_a_part, [&](std::size_t begin, std::size_t end) {
      for (const auto& contact : contacts.subspan(begin, end - begin)) contact.put_back(contacts_);
    });
  };
  put_back(reach_.contacts());
  put_back(reach_.balls());
  for (const Rebound& rebound : rebounds_) start_anew({rebound.lane, rebound.point}, 0);
}

}  // namespace tweenfall::blocks
