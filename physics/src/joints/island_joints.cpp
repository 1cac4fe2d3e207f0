#include "joints/island_joints.h"

#include <tweenfall/curves/rotation.h>

#include <algorithm>

#include "joints/kinds/kinds.h"

namespace tweenfall::joints {

using blocks::BodyLanes;
using blocks::IslandBody;

namespace {

/// Share of an error that a sub-step takes apart.
constexpr double taken_apart = 0.3;
/// In shorter steps than this, s, errors are taken apart more slowly: the speed that it needs is the shorter the step
/// the greater.
constexpr double unhurried = 1e-3;
/// The bend of an arc tells nothing when a sub-step turns further, rad.
constexpr double followable = 0.3;
/// Impulses of sub-steps much shorter than the last one kept hold mostly rounding, which would grow with the ratio.
constexpr double long_enough = 0.15;
/// After so many times the last one's length what it told is old.
constexpr double old_after = 24;
/// So often rows change places between those in and those beside, before those that bound stay where they are.
constexpr int most_rounds = 4;
/// So often places are brought together at the end of a step, and how near they are then by once more, m or rad.
constexpr int most_closings = 5;
constexpr double closed = 2e-3;
/// What is passed by less than this is not, m/s or rad/s.
constexpr double passable = 1e-10;

double speed_of(const Direction& direction, const BodyLanes& a, const BodyLanes& b) {
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    sum += direction.linear_b[i] * b.linear[i] + direction.turn_b[i] * b.angular[i] -
           direction.linear_a[i] * a.linear[i] - direction.turn_a[i] * a.angular[i];
  return sum;
}

/// Whole turns are counted from sub-step to sub-step.
void keep_turns(state::Joint& joint, const Placement& at) {
  const JointKind& kind = joint.settings.kind;
  if (const auto* hinge = std::get_if<HingeJoint>(&kind)) {
    joint.angles[0] = coordinates_of(*hinge, joint, at).position[0];
  } else if (const auto* wheel = std::get_if<WheelJoint>(&kind)) {
    joint.angles[0] = coordinates_of(*wheel, joint, at).position[0];
  } else if (const auto* universal = std::get_if<UniversalJoint>(&kind)) {
    const Coordinates angles = coordinates_of(*universal, joint, at);
    joint.angles = {angles.position[0], angles.position[1]};
  }
}

}  // namespace

void IslandJoints::build(std::span<JointLink* const> links, const std::vector<std::uint32_t>& places,
                         const std::vector<IslandBody>& island, double h, double dt) {
  h_ = h;
  dt_ = dt;
  const double hurry = std::min(1.0, dt / unhurried);
  rate_ = hurry * hurry * taken_apart / h;
  if (entries_.size() < links.size()) entries_.resize(links.size());
  joints_ = std::span(entries_).first(links.size());
  members_.resize(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    Entry& entry = joints_[i];
    state::Joint& joint = *links[i]->joint;
    entry.joint = &joint;
    entry.a = links[i]->a == JointLink::world ? 0 : places[links[i]->a];
    entry.b = places[links[i]->b];
    entry.push = entry.turn = Vec3::Zero();
    const double ratio = joint.kept_step > h ? h / joint.kept_step : 1;
    for (std::size_t k = 0; k < joint.kept.size(); ++k) entry.rows.impulses[k] = ratio * joint.kept[k];
    members_[i] = {entry.a,
                   entry.b,
                   entry.a != 0 && island[entry.a].movable,
                   island[entry.b].movable,
                   static_cast<std::uint32_t>(i),
                   &entry.rows};
  }
  find_figures(island);
}

void IslandJoints::find_figures(const std::vector<IslandBody>& island) {
  figure_count_ = 0;
  if (members_.empty()) return;
  plans_.fit(island.size());
  roots_.resize(island.size());
  for (std::uint32_t i = 0; i < roots_.size(); ++i) roots_[i] = i;
  const auto root_of = [&](std::uint32_t place) {
    while (roots_[place] != place) place = roots_[place] = roots_[roots_[place]];
    return place;
  };
  for (const JointSystem::Member& member : members_) {
    if (!member.a_moves || !member.b_moves) continue;
    const std::uint32_t a = root_of(member.a), b = root_of(member.b);
    roots_[std::max(a, b)] = std::min(a, b);
  }
  // Sorted by root, and in their order otherwise.
  const auto root_of_member = [&](const JointSystem::Member& member) {
    return root_of(member.a_moves ? member.a : member.b);
  };
  std::stable_sort(members_.begin(), members_.end(),
                   [&](const JointSystem::Member& left, const JointSystem::Member& right) {
                     return root_of_member(left) < root_of_member(right);
                   });
  const auto add = [&](std::span<const JointSystem::Member> some) {
    if (figure_count_ == figures_.size()) figures_.emplace_back();
    if (!figures_[figure_count_].system.plan(some, plans_)) return false;
    ++figure_count_;
    return true;
  };
  for (std::size_t begin = 0, end = 0; begin < members_.size(); begin = end) {
    while (end < members_.size() && root_of_member(members_[end]) == root_of_member(members_[begin])) ++end;
    const std::span<const JointSystem::Member> some = std::span(members_).subspan(begin, end - begin);
    if (!add(some))
      for (std::size_t i = 0; i < some.size(); ++i) static_cast<void>(add(some.subspan(i, 1)));
  }
}

void IslandJoints::write(Entry& entry, const std::vector<state::Body>& bodies, const std::vector<IslandBody>& island,
                         const std::vector<BodyLanes>& velocities) const {
  const auto followed = [&](const BodyLanes& velocity) {
    Twist twist{blocks::linear_of(velocity), blocks::angular_of(velocity)};
    const double turn = twist.angular.norm() * h_;
    if (turn > followable) twist.angular *= followable / turn;
    return twist;
  };
  const IslandBody& a = island[entry.a];
  const IslandBody& b = island[entry.b];
  const Vec3 mass_center_a = entry.a == 0 ? Vec3(0, 0, 0) : bodies[a.index].mass().center;
  Placement at = placement_of(entry.joint->settings, a.center, a.rotation, mass_center_a, b.center, b.rotation,
                              bodies[b.index].mass().center);
  at.twist_a = followed(velocities[entry.a]);
  at.twist_b = followed(velocities[entry.b]);
  entry.inverse_mass_a = a.inverse_mass;
  entry.inverse_mass_b = b.inverse_mass;
  entry.arm_b = at.arm_b;
  entry.axis_a = at.x_a();
  entry.axis_b = at.x_b();
  entry.rows.begin({a.inverse_mass, b.inverse_mass, a.inverse_inertia, b.inverse_inertia}, h_, rate_, dt_,
                   h_ * (at.twist_b.angular - at.twist_a.angular).norm());
  std::visit([&](const auto& kind) { write_rows(kind, *entry.joint, at, entry.rows); }, entry.joint->settings.kind);
  keep_turns(*entry.joint, at);
}

void IslandJoints::write(const std::vector<state::Body>& bodies, const std::vector<IslandBody>& island,
                         const std::vector<BodyLanes>& velocities) {
  for (Entry& entry : joints_) write(entry, bodies, island, velocities);
  for (std::size_t i = 0; i < figure_count_; ++i) figures_[i].stale = true;
}

void IslandJoints::begin_sub_step(const std::vector<state::Body>& bodies, const std::vector<IslandBody>& island,
                                  const std::vector<BodyLanes>& starts, std::vector<BodyLanes>& velocities) {
  if (joints_.empty()) return;
  write(bodies, island, starts);
  for (const Entry& entry : joints_)
    for (std::size_t i = 0; i < entry.rows.count; ++i)
      if (entry.rows.impulses[i] != 0) apply(entry, entry.rows.rows[i], entry.rows.impulses[i], velocities);
}

/// Newton's method for the places, by the factors that the velocities need next. A blow turns limbs far within a
/// sub-step: what holds along straight lines leaves the arcs, and bounds are passed.
void IslandJoints::close_gaps(const std::vector<state::Body>& bodies, std::vector<IslandBody>& island,
                              const std::vector<BodyLanes>& velocities) {
  moves_.assign(island.size(), {});
  for (std::size_t n = 0; n < figure_count_; ++n) {
    Figure& figure = figures_[n];
    for (int round = 0; round < most_closings; ++round) {
      // What holds has the last word.
      const bool last = round + 1 == most_closings;
      if (close_gaps(figure, island, last) < closed || last) break;
      for (std::size_t place = 0; place < figure.system.size(); ++place)
        write(joints_[figure.system.member(place).joint], bodies, island, velocities);
    }
  }
}

/// @return the widest that there was, m or rad
double IslandJoints::close_gaps(Figure& figure, std::vector<IslandBody>& island, bool of_what_holds) {
  JointSystem& system = figure.system;
  figure.stale = false;
  for (std::size_t place = 0; place < system.size(); ++place) {
    JointRows& rows = joints_[system.member(place).joint].rows;
    if (of_what_holds)
      rows.hold_only();
    else if (rows.keep_passed())
      figure.stale = true;
  }
  system.factor();
  double widest = 0;
  for (std::size_t place = 0; place < system.size(); ++place) {
    const Entry& entry = joints_[system.member(place).joint];
    const std::span<const std::uint8_t> slots = system.slots(place);
    for (std::size_t i = 0; i < slots.size(); ++i) {
      const double left = entry.rows.rows[slots[i]].left;
      system.values(place)[i] = left;
      widest = std::max(widest, std::abs(left));
    }
  }
  system.solve();
  for (std::size_t place = 0; place < system.size(); ++place) {
    const Entry& entry = joints_[system.member(place).joint];
    const std::span<const std::uint8_t> slots = system.slots(place);
    for (std::size_t i = 0; i < slots.size(); ++i)
      apply(entry, entry.rows.rows[slots[i]], system.values(place)[i], moves_);
  }
  for (std::size_t place = 0; place < system.size(); ++place)
    for (const std::uint32_t end : {system.member(place).a, system.member(place).b}) {
      IslandBody& body = island[end];
      const Vec3 turn = blocks::angular_of(moves_[end]);
      body.center += blocks::linear_of(moves_[end]);
      if (turn != Vec3::Zero()) body.rotation = (exp_map(turn) * body.rotation).normalized();
      moves_[end] = {};
    }
  return widest;
}

void IslandJoints::end_step(const std::vector<state::Body>& bodies, std::vector<IslandBody>& island,
                            std::vector<BodyLanes>& velocities) {
  if (joints_.empty()) return;
  store();
  write(bodies, island, velocities);
  close_gaps(bodies, island, velocities);
  for (Entry& entry : joints_) {
    entry.rows.hold_only();
    for (std::size_t i = 0; i < entry.rows.together; ++i) entry.rows.rows[i].wanted_after = 0;
  }
  solve(velocities, false, false);
  add_up();
  for (const Entry& entry : joints_) {
    entry.joint->force = entry.push / dt_;
    entry.joint->torque = entry.turn / dt_;
  }
}

void IslandJoints::apply(const Entry& entry, const Row& row, double impulse, std::vector<BodyLanes>& velocities) {
  BodyLanes& a = velocities[entry.a];
  BodyLanes& b = velocities[entry.b];
  const double push_a = entry.inverse_mass_a * impulse;
  const double push_b = entry.inverse_mass_b * impulse;
  for (int i = 0; i < 3; ++i) {
    a.linear[i] -= push_a * row.direction.linear_a[i];
    a.angular[i] -= impulse * row.spin_a[i];
    b.linear[i] += push_b * row.direction.linear_b[i];
    b.angular[i] += impulse * row.spin_b[i];
  }
}

double IslandJoints::lack(const Entry& entry, std::size_t slot, bool moving, const std::vector<BodyLanes>& velocities) {
  const Row& row = entry.rows.rows[slot];
  return (moving ? row.wanted : row.wanted_after) - row.compliance * entry.rows.impulses[slot] -
         speed_of(row.direction, velocities[entry.a], velocities[entry.b]);
}

/// Solves all rows that are in for the speeds that they want.
void IslandJoints::solve_in(Figure& figure, std::vector<BodyLanes>& velocities, bool moving) {
  JointSystem& system = figure.system;
  if (figure.stale) system.factor();
  figure.stale = false;
  figure.bounded = false;
  for (std::size_t place = 0; place < system.size(); ++place) {
    Entry& entry = joints_[system.member(place).joint];
    const std::span<const std::uint8_t> slots = system.slots(place);
    for (std::size_t i = 0; i < slots.size(); ++i) {
      double& impulse = entry.rows.impulses[slots[i]];
      if (impulse == 0 || system.says_something(place, i)) continue;
      apply(entry, entry.rows.rows[slots[i]], -impulse, velocities);
      impulse = 0;
    }
  }
  for (std::size_t place = 0; place < system.size(); ++place) {
    const Entry& entry = joints_[system.member(place).joint];
    const std::span<const std::uint8_t> slots = system.slots(place);
    figure.bounded = figure.bounded || (!slots.empty() && slots.back() >= entry.rows.together);
    double* values = system.values(place);
    const double* inverses = system.inverses(place);
    for (std::size_t i = 0; i < slots.size(); ++i)
      values[i] = lack(entry, slots[i], moving, velocities) - give * inverses[i] * entry.rows.impulses[slots[i]];
  }
  system.solve();
  for (std::size_t place = 0; place < system.size(); ++place) {
    Entry& entry = joints_[system.member(place).joint];
    const std::span<const std::uint8_t> slots = system.slots(place);
    const double* values = system.values(place);
    for (std::size_t i = 0; i < slots.size(); ++i) {
      if (values[i] == 0) continue;
      apply(entry, entry.rows.rows[slots[i]], values[i], velocities);
      entry.rows.impulses[slots[i]] += values[i];
    }
  }
}

/// Lets in what is beside and would be passed. @return whether anything came in
bool IslandJoints::admit(Figure& figure, const std::vector<BodyLanes>& velocities, bool moving) {
  bool changed = false;
  for (std::size_t place = 0; place < figure.system.size(); ++place) {
    Entry& entry = joints_[figure.system.member(place).joint];
    for (std::size_t i = entry.rows.together; i < entry.rows.count; ++i) {
      if (entry.rows.parts[i] != Part::beside) continue;
      const Row& row = entry.rows.rows[i];
      const double impulse = entry.rows.impulses[i];
      const double rest = lack(entry, i, moving, velocities);
      if (!(rest > passable && impulse < row.high) && !(rest < -passable && impulse > row.low)) continue;
      entry.rows.parts[i] = Part::in;
      changed = true;
    }
  }
  figure.stale = figure.stale || changed;
  return changed;
}

/// Takes out what came to lie beyond its bound, or at it. @param all  also what did not
bool IslandJoints::dismiss(Figure& figure, std::vector<BodyLanes>& velocities, bool all) {
  bool changed = false;
  for (std::size_t place = 0; place < figure.system.size(); ++place) {
    Entry& entry = joints_[figure.system.member(place).joint];
    for (std::size_t i = entry.rows.together; i < entry.rows.count; ++i) {
      if (entry.rows.parts[i] != Part::in) continue;
      const Row& row = entry.rows.rows[i];
      double& impulse = entry.rows.impulses[i];
      if (!all && impulse >= row.low && impulse <= row.high) continue;
      const double bounded = std::clamp(impulse, row.low, row.high);
      if (bounded != impulse) apply(entry, row, bounded - impulse, velocities);
      impulse = bounded;
      entry.rows.parts[i] = Part::beside;
      changed = true;
    }
  }
  figure.stale = figure.stale || changed;
  return changed;
}

void IslandJoints::solve(Figure& figure, std::vector<BodyLanes>& velocities, bool moving) {
  admit(figure, velocities, moving);
  solve_in(figure, velocities, moving);
  for (int round = 0; round < most_rounds; ++round) {
    const bool out = dismiss(figure, velocities, false);
    const bool in = admit(figure, velocities, moving);
    if (!out && !in) {
      if (figure.bounded && !moving) solve_in(figure, velocities, moving);
      return;
    }
    solve_in(figure, velocities, moving);
  }
  // What holds has the last word.
  if (dismiss(figure, velocities, true)) solve_in(figure, velocities, moving);
}

void IslandJoints::solve(std::vector<BodyLanes>& velocities, bool moving, bool backward) {
  for (std::size_t i = 0; i < figure_count_; ++i)
    solve(figures_[backward ? figure_count_ - 1 - i : i], velocities, moving);
}

void IslandJoints::move(const std::vector<BodyLanes>& velocities) {
  for (Entry& entry : joints_) {
    // What pressed against a bound is there now.
    for (std::size_t i = entry.rows.together; i < entry.rows.count; ++i) {
      if (entry.rows.parts[i] == Part::idle) continue;
      Row& row = entry.rows.rows[i];
      if (row.low == 0 && entry.rows.impulses[i] > 0 && row.wanted < 0 && row.compliance == 0) row.wanted_after = 0;
    }
    if (!std::holds_alternative<GearJoint>(entry.joint->settings.kind)) continue;
    const BodyLanes& a = velocities[entry.a];
    const BodyLanes& b = velocities[entry.b];
    for (int i = 0; i < 3; ++i) {
      entry.joint->angles[0] += h_ * a.angular[i] * entry.axis_a[i];
      entry.joint->angles[1] += h_ * b.angular[i] * entry.axis_b[i];
    }
  }
}

void IslandJoints::add_up() {
  for (Entry& entry : joints_)
    for (std::size_t i = 0; i < entry.rows.count; ++i) {
      const double impulse = entry.rows.impulses[i];
      if (impulse == 0) continue;
      const Vec3 push = impulse * entry.rows.rows[i].direction.linear_b;
      entry.push += push;
      entry.turn += impulse * entry.rows.rows[i].direction.turn_b - entry.arm_b.cross(push);
    }
}

void IslandJoints::store() {
  for (Entry& entry : joints_) {
    state::Joint& joint = *entry.joint;
    if (h_ < long_enough * joint.kept_step) {
      joint.passed_over += dt_;
      if (joint.passed_over < old_after * joint.kept_step) continue;
    }
    joint.kept = {};
    for (std::size_t i = 0; i < entry.rows.count; ++i) joint.kept[i] = entry.rows.impulses[i];
    joint.kept_step = h_;
    joint.passed_over = 0;
  }
}

}  // namespace tweenfall::joints
