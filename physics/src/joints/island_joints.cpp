#include "joints/island_joints.h"

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
  joints_.resize(links.size());
  members_.resize(links.size());
  masses_.resize(links.size());
  impulses_.resize(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    Entry& entry = joints_[i];
    state::Joint& joint = *links[i]->joint;
    entry.joint = &joint;
    entry.a = links[i]->a == JointLink::world ? 0 : places[links[i]->a];
    entry.b = places[links[i]->b];
    entry.push = entry.turn = Vec3::Zero();
    const double ratio = joint.kept_step > h ? h / joint.kept_step : 1;
    for (std::size_t k = 0; k < joint.kept.size(); ++k) entry.rows.rows[k].impulse = ratio * joint.kept[k];
    members_[i] = {entry.a, entry.b, entry.a != 0 && island[entry.a].movable, island[entry.b].movable, &entry.rows};
  }
  if (!links.empty()) system_.plan(members_, island.size());
}

void IslandJoints::write(const std::vector<state::Body>& bodies, const std::vector<IslandBody>& island,
                         const std::vector<BodyLanes>& velocities) {
  const auto followed = [&](const BodyLanes& velocity) {
    Twist twist{blocks::linear_of(velocity), blocks::angular_of(velocity)};
    const double turn = twist.angular.norm() * h_;
    if (turn > followable) twist.angular *= followable / turn;
    return twist;
  };
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    Entry& entry = joints_[i];
    const IslandBody& a = island[entry.a];
    const IslandBody& b = island[entry.b];
    const Vec3 mass_center_a = entry.a == 0 ? Vec3(0, 0, 0) : bodies[a.index].mass.center;
    Placement at = placement_of(entry.joint->settings, a.center, a.rotation, mass_center_a, b.center, b.rotation,
                                bodies[b.index].mass.center);
    at.twist_a = followed(velocities[entry.a]);
    at.twist_b = followed(velocities[entry.b]);
    entry.inverse_mass_a = a.inverse_mass;
    entry.inverse_mass_b = b.inverse_mass;
    entry.arm_b = at.arm_b;
    entry.axis_a = at.x_a();
    entry.axis_b = at.x_b();
    masses_[i] = {a.inverse_mass, b.inverse_mass, a.inverse_inertia, b.inverse_inertia};
    entry.rows.begin(masses_[i], h_, rate_);
    std::visit([&](const auto& kind) { write_rows(kind, *entry.joint, at, entry.rows); }, entry.joint->settings.kind);
    entry.rows.finish();
    keep_turns(*entry.joint, at);
  }
  system_.factor(masses_);
}

void IslandJoints::begin_sub_step(const std::vector<state::Body>& bodies, const std::vector<IslandBody>& island,
                                  const std::vector<BodyLanes>& starts, std::vector<BodyLanes>& velocities) {
  if (joints_.empty()) return;
  write(bodies, island, starts);
  for (const Entry& entry : joints_)
    for (std::size_t i = 0; i < entry.rows.count; ++i) {
      const Row& row = entry.rows.rows[i];
      if (row.impulse != 0) apply(entry, row, row.impulse, velocities);
    }
}

void IslandJoints::end_step(const std::vector<state::Body>& bodies, const std::vector<IslandBody>& island,
                            std::vector<BodyLanes>& velocities) {
  if (joints_.empty()) return;
  store();
  write(bodies, island, velocities);
  for (Entry& entry : joints_)
    for (Row& row : entry.rows.rows) row.impulse = row.wanted_after = 0;
  solve_together(velocities, false, false);
  add_up();
  for (const Entry& entry : joints_) {
    entry.joint->force = entry.push / dt_;
    entry.joint->torque = entry.turn / dt_;
  }
}

void IslandJoints::apply(const Entry& entry, const Row& row, double impulse, std::vector<BodyLanes>& velocities) const {
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

void IslandJoints::solve_bounds(Entry& entry, std::vector<BodyLanes>& velocities, bool moving) {
  for (std::size_t i = entry.rows.together; i < entry.rows.count; ++i) {
    Row& row = entry.rows.rows[i];
    if (row.mass == 0) continue;
    const double wanted = moving ? row.wanted : row.wanted_after;
    const double speed = speed_of(row.direction, velocities[entry.a], velocities[entry.b]);
    const double next = row.impulse + row.firm * row.mass * (wanted - speed) - row.giving * row.impulse;
    const double bounded = std::clamp(next, row.low, row.high);
    const double change = bounded - row.impulse;
    if (change == 0) continue;
    apply(entry, row, change, velocities);
    row.impulse = bounded;
    for (std::size_t k = 0; k < entry.rows.together; ++k) {
      if (row.along[k] == 0) continue;
      apply(entry, entry.rows.rows[k], -change * row.along[k], velocities);
      entry.rows.rows[k].impulse -= change * row.along[k];
    }
  }
}

void IslandJoints::solve_together(std::vector<BodyLanes>& velocities, bool moving, bool backward) {
  const auto find = [&](std::size_t n) {
    const Entry& entry = joints_[n];
    for (std::size_t i = 0; i < entry.rows.together; ++i) {
      const Row& row = entry.rows.rows[i];
      const double lost = row.mass > 0 ? give * row.impulse / row.mass : 0;
      impulses_[n][i] = (moving ? row.wanted : row.wanted_after) - lost -
                        speed_of(row.direction, velocities[entry.a], velocities[entry.b]);
    }
  };
  const auto hand_out = [&](std::size_t n) {
    Entry& entry = joints_[n];
    for (std::size_t i = 0; i < entry.rows.together; ++i) {
      if (impulses_[n][i] == 0) continue;
      apply(entry, entry.rows.rows[i], impulses_[n][i], velocities);
      entry.rows.rows[i].impulse += impulses_[n][i];
    }
  };
  if (system_.whole()) {
    for (std::size_t n = 0; n < joints_.size(); ++n) find(n);
    system_.solve(impulses_);
    for (std::size_t n = 0; n < joints_.size(); ++n) hand_out(n);
    return;
  }
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const std::size_t n = backward ? joints_.size() - 1 - k : k;
    find(n);
    system_.solve_alone(n, impulses_[n]);
    hand_out(n);
  }
}

void IslandJoints::solve(std::vector<BodyLanes>& velocities, bool moving, bool backward) {
  if (joints_.empty()) return;
  // Bounds first: what must hold has the last word.
  for (std::size_t n = 0; n < joints_.size(); ++n)
    solve_bounds(joints_[backward ? joints_.size() - 1 - n : n], velocities, moving);
  solve_together(velocities, moving, backward);
}

bool IslandJoints::find_held(std::vector<IslandBody>& island) const {
  bool anchored = false;
  for (const Entry& entry : joints_) {
    const auto acts = [](const Row& row) { return row.impulse != 0; };
    if (std::none_of(entry.rows.rows.begin(), entry.rows.rows.begin() + static_cast<std::ptrdiff_t>(entry.rows.count),
                     acts))
      continue;
    island[entry.a].jointed = island[entry.b].jointed = true;
    anchored = anchored || entry.a == 0;
  }
  return anchored;
}

void IslandJoints::move(const std::vector<BodyLanes>& velocities) {
  for (Entry& entry : joints_) {
    // What pressed against a bound is there now.
    for (std::size_t i = entry.rows.together; i < entry.rows.count; ++i) {
      Row& row = entry.rows.rows[i];
      if (row.low == 0 && row.impulse > 0 && row.wanted < 0 && row.giving == 0) row.wanted_after = 0;
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
      const Row& row = entry.rows.rows[i];
      const Vec3 push = row.impulse * row.direction.linear_b;
      entry.push += push;
      entry.turn += row.impulse * row.direction.turn_b - entry.arm_b.cross(push);
    }
}

void IslandJoints::forget() {
  for (Entry& entry : joints_)
    for (Row& row : entry.rows.rows) row.impulse = 0;
}

void IslandJoints::store() {
  for (Entry& entry : joints_) {
    state::Joint& joint = *entry.joint;
    if (h_ < long_enough * joint.kept_step) {
      joint.passed_over += dt_;
      if (joint.passed_over < old_after * joint.kept_step) continue;
    }
    joint.kept = {};
    for (std::size_t i = 0; i < entry.rows.count; ++i) joint.kept[i] = entry.rows.rows[i].impulse;
    joint.kept_step = h_;
    joint.passed_over = 0;
  }
}

}  // namespace tweenfall::joints
