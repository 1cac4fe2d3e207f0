#include "joints/island_joints.h"

#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>

#include "joints/kinds/kinds.h"

namespace tweenfall::joints {

using blocks::BodyLanes;
using blocks::IslandBody;

namespace {

/// Share of an error that a sub-step corrects.
constexpr double taken_apart = 0.3;
/// In shorter steps than this, s, errors are corrected more slowly: the shorter the step, the greater the
/// speed it needs.
constexpr double unhurried = 1e-3;
/// Impulses of sub-steps much shorter than the last one kept are mostly rounding, which would grow with the ratio.
constexpr double long_enough = 0.15;
/// After this many times the length of the last kept sub-step, its impulses are too old.
constexpr double old_after = 24;
/// Most rounds that close errors at the end of a step; one that starts with errors below `closed`, m or rad, is the
/// last.
constexpr int most_closings = 5;
constexpr double closed = 2e-3;

Writing writing_of(const JointKind& kind) {
  if (std::holds_alternative<BallJoint>(kind)) return Writing::point;
  const auto* limb = std::get_if<SwingTwistJoint>(&kind);
  return limb && !limb->toward && !(limb->twist.hz > 0) ? Writing::limb : Writing::by_kind;
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

void IslandJoints::build(std::span<JointLink* const> links, const std::vector<state::Body>& bodies,
                         const std::vector<std::uint32_t>& places, const std::vector<IslandBody>& island, double h,
                         double dt, const threads::Workers& workers) {
  work_ = workers;
  h_ = h;
  dt_ = dt;
  const double hurry = std::min(1.0, dt / unhurried);
  rate_ = hurry * hurry * taken_apart / h;
  joints_.resize(links.size());
  members_.resize(links.size());
  kinds_.resize(links.size());
  const auto take = [&](std::size_t i) {
    Entry& entry = joints_[i];
    state::Joint& joint = *links[i]->joint;
    entry.joint = &joint;
    entry.a = links[i]->a == JointLink::world ? 0 : places[links[i]->a];
    entry.b = places[links[i]->b];
    const double ratio = joint.kept_step > h ? h / joint.kept_step : 1;
    for (std::size_t k = 0; k < joint.kept.size(); ++k) entry.impulses[k] = ratio * joint.kept[k];
    kinds_[i] = FigureGroup::kind_number(joint.settings.kind.index(), writing_of(joint.settings.kind));
    members_[i] = {entry.a, entry.b, entry.a != 0 && island[entry.a].movable, island[entry.b].movable,
                   static_cast<std::uint32_t>(i)};
  };
  constexpr std::size_t worth_a_part = 48;
  work_.ranges(links.size(), worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) take(i);
  });
  gears_.clear();
  for (std::uint32_t i = 0; i < links.size(); ++i)
    if (std::holds_alternative<GearJoint>(links[i]->joint->settings.kind)) gears_.push_back(i);
  find_figures(island);
  each_group([&](FigureGroup& group) { frame(group, bodies, island); });
}

void IslandJoints::frame(FigureGroup& group, const std::vector<state::Body>& bodies,
                         const std::vector<IslandBody>& island) {
  for (std::uint32_t place = 0; place < group.size(); ++place) {
    if (group.writing(place) == Writing::by_kind) continue;
    for (int lane = 0; lane < group.lanes(); ++lane) {
      const Entry& entry = joints_[group.joint(place, lane)];
      const JointSettings& settings = entry.joint->settings;
      const Vec3 pivot_a = entry.a == 0 ? settings.frame_a.position
                                        : Vec3(settings.frame_a.position - bodies[island[entry.a].index].mass().center);
      group.frame(place, lane, *entry.joint, pivot_a,
                  settings.frame_b.position - bodies[island[entry.b].index].mass().center, entry.impulses);
    }
  }
}

void IslandJoints::find_figures(const std::vector<IslandBody>& island) {
  group_count_ = 0;
  if (members_.empty()) return;
  room_.fit(island.size());
  local_.assign(island.size(), 0);
  roots_.resize(island.size());
  for (std::uint32_t i = 0; i < roots_.size(); ++i) roots_[i] = i;
  const auto root_of = [&](std::uint32_t place) {
    while (roots_[place] != place) place = roots_[place] = roots_[roots_[place]];
    return place;
  };
  for (const FigurePlan::Member& member : members_) {
    if (!member.a_moves || !member.b_moves) continue;
    const std::uint32_t a = root_of(member.a), b = root_of(member.b);
    roots_[std::max(a, b)] = std::min(a, b);
  }
  // Sorted by root, and otherwise in their order: runs of one root are, since most figures come in one.
  runs_.clear();
  for (std::uint32_t i = 0; i < members_.size(); ++i) {
    const std::uint32_t root = root_of(members_[i].a_moves ? members_[i].a : members_[i].b);
    if (runs_.empty() || runs_.back().root != root) runs_.push_back({root, i, i});
    runs_.back().end = i + 1;
  }
  std::sort(runs_.begin(), runs_.end(),
            [](const Run& a, const Run& b) { return std::pair(a.root, a.begin) < std::pair(b.root, b.begin); });
  for (std::size_t first = 0, next = 0; first < runs_.size(); first = next) {
    given_.clear();
    for (; next < runs_.size() && runs_[next].root == runs_[first].root; ++next)
      given_.insert(given_.end(), members_.begin() + runs_[next].begin, members_.begin() + runs_[next].end);
    const std::span<const FigurePlan::Member> some = given_;
    if (KnownPlan& known = plan_for(some); known.found) {
      known.plan.change_members(some);
      add_figure(known.plan, known.shape, true);
      continue;
    }
    for (std::size_t i = 0; i < some.size(); ++i) {
      static_cast<void>(plan_.make(some.subspan(i, 1), room_));
      FigureGroup::find_shape(plan_.members(), kinds_, local_, shape_);
      add_figure(plan_, shape_, false);
    }
  }
}

IslandJoints::KnownPlan& IslandJoints::plan_for(std::span<const FigurePlan::Member> members) {
  FigureGroup::find_shape(members, kinds_, local_, shape_);
  for (KnownPlan& known : known_)
    if (known.given == shape_) return known;
  if (known_.size() < most_known) known_.emplace_back();
  KnownPlan& known = known_[next_known_++ % most_known];
  known.given = shape_;
  known.found = known.plan.make(members, room_);
  if (known.found) FigureGroup::find_shape(known.plan.members(), kinds_, local_, known.shape);
  return known;
}

void IslandJoints::add_figure(const FigurePlan& plan, const FigureGroup::Shape& shape, bool whole) {
  if (whole)
    for (FigureGroup& group : groups())
      if (group.take(plan, shape)) return;
  if (group_count_ == groups_.size()) groups_.emplace_back();
  groups_[group_count_++].begin(plan, shape, whole);
}

void IslandJoints::write(Entry& entry, const std::vector<state::Body>& bodies, const std::vector<IslandBody>& island,
                         const std::vector<BodyLanes>& velocities, JointRows& rows) {
  const auto followed = [&](const BodyLanes& velocity) {
    Twist twist{blocks::linear_of(velocity), blocks::angular_of(velocity)};
    const double turn = twist.angular.squaredNorm() * h_ * h_;
    if (turn > followable * followable) twist.angular *= followable / std::sqrt(turn);
    return twist;
  };
  const IslandBody& a = island[entry.a];
  const IslandBody& b = island[entry.b];
  const Vec3 mass_center_a = entry.a == 0 ? Vec3(0, 0, 0) : bodies[a.index].mass().center;
  Placement at = placement_of(entry.joint->settings, a.center, a.rotation, mass_center_a, b.center, b.rotation,
                              bodies[b.index].mass().center);
  at.twist_a = followed(velocities[entry.a]);
  at.twist_b = followed(velocities[entry.b]);
  entry.arm_a = at.arm_a;
  entry.arm_b = at.arm_b;
  if (std::holds_alternative<GearJoint>(entry.joint->settings.kind)) {
    entry.axis_a = at.x_a();
    entry.axis_b = at.x_b();
  }
  rows.impulses = entry.impulses;
  rows.begin({a.inverse_mass, b.inverse_mass, a.inverse_inertia, b.inverse_inertia}, at, h_, rate_, dt_);
  if (closing_) rows.errors_only();
  std::visit([&](const auto& kind) { write_rows(kind, *entry.joint, at, rows); }, entry.joint->settings.kind);
  entry.impulses = rows.impulses;
  keep_turns(*entry.joint, at);
}

void IslandJoints::write(FigureGroup& group, const blocks::Lanes& live, const std::vector<state::Body>& bodies,
                         const std::vector<IslandBody>& island, const std::vector<BodyLanes>& velocities) {
  group.write(island, velocities, live, {h_, rate_, dt_, closing_});
  JointRows rows;
  for (std::uint32_t place = 0; place < group.size(); ++place)
    for (int lane = 0; lane < group.lanes(); ++lane) {
      if (live[lane] == 0 || group.writing(place) != Writing::by_kind) continue;
      Entry& entry = joints_[group.joint(place, lane)];
      write(entry, bodies, island, velocities, rows);
      group.load(place, lane, rows, entry.arm_a, entry.arm_b);
    }
  group.end_load();
}

void IslandJoints::unload(const FigureGroup& group, bool in_lanes, const blocks::Lanes& kept) {
  for (std::uint32_t place = 0; place < group.size(); ++place)
    for (int lane = 0; lane < group.lanes() && (group.writing(place) != Writing::by_kind) == in_lanes; ++lane)
      group.unload(place, lane, joints_[group.joint(place, lane)].impulses, kept[lane]);
}

void IslandJoints::begin_sub_step(const std::vector<state::Body>& bodies, const std::vector<IslandBody>& island,
                                  const std::vector<BodyLanes>& starts, std::vector<BodyLanes>& velocities) {
  if (joints_.empty()) return;
  closing_ = false;
  each_group([&](FigureGroup& group) {
    group.load_bodies(island);
    write(group, blocks::all(1), bodies, island, starts);
    fastest_figure_kernels().warm_start(group.figures(velocities));
  });
}

void IslandJoints::end_sub_step(FigureGroup& group, const blocks::Lanes& kept) {
  fastest_figure_kernels().add_up(group.figures());
  group.keep_impulses(kept);
  unload(group, false, kept);
}

/// Newton's method for positions, with the factors that the velocities need next. A blow turns limbs far within a
/// sub-step: rows that hold along straight lines leave the arcs, and bounds are passed.
void IslandJoints::close_gaps(FigureGroup& group, const std::vector<state::Body>& bodies,
                              std::vector<IslandBody>& island, const std::vector<BodyLanes>& velocities) {
  blocks::Lanes live = blocks::all(1);
  blocks::Lanes widest;
  for (int round = 0; round < most_closings; ++round) {
    // Rows that hold have the last word.
    const bool last = round + 1 == most_closings;
    fastest_figure_kernels().close(group.figures(), last, live, widest);
    bool any = false;
    for (int lane = 0; lane < group.lanes(); ++lane) {
      if (live[lane] == 0) continue;
      for (std::uint32_t number = 0; number < group.body_count(); ++number) {
        const FigureBody& moves = group.body(number);
        if (!moves.moves) continue;
        IslandBody& body = island[group.body(number, lane)];
        const Vec3 turn = blocks::lane_of(moves.angular, lane);
        body.center += blocks::lane_of(moves.linear, lane);
        if (turn != Vec3::Zero()) body.rotation = (exp_map(turn) * body.rotation).normalized();
      }
      if (widest[lane] < closed) live[lane] = 0;
      any = any || live[lane] != 0;
    }
    if (last || !any) break;
    write(group, live, bodies, island, velocities);
  }
}

void IslandJoints::end_step(const std::vector<state::Body>& bodies, std::vector<IslandBody>& island,
                            std::vector<BodyLanes>& velocities) {
  if (joints_.empty()) return;
  each_group([&](const FigureGroup& group) { unload(group, true, blocks::all(1)); });
  store();
  closing_ = true;
  // All see the positions at the end of the last sub-step.
  each_group([&](FigureGroup& group) {
    group.load_bodies(island);
    write(group, blocks::all(1), bodies, island, velocities);
  });
  each_group([&](FigureGroup& group) {
    close_gaps(group, bodies, island, velocities);
    Figures& figures = group.figures(velocities);
    fastest_figure_kernels().hold_only(figures);
    fastest_figure_kernels().solve(figures, false);
    fastest_figure_kernels().add_up(figures);
  });
  each([this](const FigureGroup& group, std::uint32_t place, int lane) {
    state::Joint& joint = *joints_[group.joint(place, lane)].joint;
    joint.force = group.push(place, lane) / dt_;
    joint.torque = group.turn(place, lane) / dt_;
    if (group.writing(place) == Writing::limb) joint.side = group.side(place, lane);
  });
}

void IslandJoints::solve(std::vector<BodyLanes>& velocities, bool moving, bool backward) {
  if (joints_.empty()) return;
  each_group([&](FigureGroup& group) { fastest_figure_kernels().solve(group.figures(velocities), moving); }, backward);
}

void IslandJoints::move(const std::vector<BodyLanes>& velocities) {
  for (FigureGroup& group : groups()) fastest_figure_kernels().moved(group.figures());
  for (const std::uint32_t gear : gears_) {
    const Entry& entry = joints_[gear];
    for (int i = 0; i < 3; ++i) {
      entry.joint->angles[0] += h_ * velocities[entry.a].angular[i] * entry.axis_a[i];
      entry.joint->angles[1] += h_ * velocities[entry.b].angular[i] * entry.axis_b[i];
    }
  }
}

void IslandJoints::store() {
  for (const Entry& entry : joints_) {
    state::Joint& joint = *entry.joint;
    if (h_ < long_enough * joint.kept_step) {
      joint.passed_over += dt_;
      if (joint.passed_over < old_after * joint.kept_step) continue;
    }
    joint.kept = entry.impulses;
    joint.kept_step = h_;
    joint.passed_over = 0;
  }
}

}  // namespace tweenfall::joints
