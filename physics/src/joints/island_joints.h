#pragma once

#include <span>
#include <vector>

#include "islands/blocks/contact_block.h"
#include "islands/blocks/island_body.h"
#include "joints/figure_group.h"
#include "joints/joint_link.h"
#include "joints/joint_rows.h"
#include "threads/workers.h"

namespace tweenfall::joints {

/// The joints of islands in sub-steps: errors are corrected while bodies move, and the speed this gave is removed
/// afterwards. Joints that are connected are solved at once: the rows that hold, and of those that bound or drive all
/// that are not at their bounds. Sources: Macklin and others, Small Steps in Physics Simulation, SCA 2019; Catto,
/// Solver2D, 2024 (relaxation); Cottle, Pang and Stone, The Linear Complementarity Problem, 1992 (rows change places by
/// the signs of the results).
class IslandJoints {
 public:
  /// Starts with the impulses that the joints kept.
  /// @param places  from a body's index to its place in the island; 0 for none, and for the world
  void build(std::span<JointLink* const> links, const std::vector<state::Body>& bodies,
             const std::vector<std::uint32_t>& places, const std::vector<blocks::IslandBody>& island, double h,
             double dt, const threads::Workers& workers);
  [[nodiscard]] bool empty() const { return joints_.empty(); }

  /// Writes the rows for the present positions of the bodies, and applies the impulses of the sub-step before again.
  /// @param starts  velocities at the start of the sub-step
  void begin_sub_step(const std::vector<state::Body>& bodies, const std::vector<blocks::IslandBody>& island,
                      const std::vector<blocks::BodyLanes>& starts, std::vector<blocks::BodyLanes>& velocities);
  /// One pass over all joints, forward or backward.
  /// @param moving  errors are being corrected
  void solve(std::vector<blocks::BodyLanes>& velocities, bool moving, bool backward);
  /// Marks the bodies that a joint acts on in this sub-step. Calls `anchored(place)` for those that can move and have
  /// an active joint whose other end cannot.
  template <class Anchored>
  void find_held(std::vector<blocks::IslandBody>& island, const Anchored& anchored) const {
    each([&](const FigureGroup& group, std::uint32_t place, int lane) {
      if (!group.acts(place, lane)) return;
      const Entry& entry = joints_[group.joint(place, lane)];
      island[entry.a].jointed = island[entry.b].jointed = true;
      // Pulleys hang on nothing that moves. What cannot move is of no island.
      const bool hangs = std::holds_alternative<PulleyJoint>(entry.joint->settings.kind);
      const bool a_moves = moves(island, entry.a), b_moves = moves(island, entry.b);
      if (b_moves && (hangs || !a_moves)) anchored(entry.b);
      if (a_moves && (hangs || !b_moves)) anchored(entry.a);
    });
  }
  /// Calls `acts(place, place)` with both ends of each joint that acts in this sub-step.
  template <class Acts>
  void each_acting(const Acts& acts) const {
    each([&](const FigureGroup& group, std::uint32_t place, int lane) {
      const Entry& entry = joints_[group.joint(place, lane)];
      if (group.acts(place, lane)) acts(entry.a, entry.b);
    });
  }
  /// The bodies move with these velocities.
  void move(const std::vector<blocks::BodyLanes>& velocities);
  /// Adds up the impulses of the sub-step. The next one starts with them. Where a body was struck, for which
  /// `struck(place)` holds, only a part of what changed is kept: a blow says little about the forces after it.
  template <class Struck>
  void end_sub_step(const Struck& struck) {
    each_group([&](FigureGroup& group) {
      blocks::Lanes kept = blocks::all(1);
      for (int lane = 0; lane < group.lanes(); ++lane)
        for (std::uint32_t i = 0; i < group.body_count(); ++i)
          if (struck(group.body(i, lane))) kept[lane] = kept_of_blow;
      end_sub_step(group, kept);
    });
  }
  /// Starts the next sub-step without impulses of joints on bodies for which `wild(place)` holds.
  template <class Wild>
  void forget(const Wild& wild) {
    for (FigureGroup& group : groups())
      for (int lane = 0; lane < group.lanes(); ++lane) {
        if (!wild(group.moving_body(lane))) continue;
        group.forget(lane);
        for (std::uint32_t place = 0; place < group.size(); ++place) joints_[group.joint(place, lane)].impulses = {};
      }
  }
  /// Returns impulses, forces and torques to the joints, removes the remaining errors by moving the bodies, and
  /// gives them velocities that fit their final positions.
  void end_step(const std::vector<state::Body>& bodies, std::vector<blocks::IslandBody>& island,
                std::vector<blocks::BodyLanes>& velocities);

 private:
  static constexpr double kept_of_blow = 0.25;

  struct Entry {
    state::Joint* joint = nullptr;
    std::uint32_t a = 0, b = 0;  ///< places
    Vec3 arm_a{0, 0, 0}, arm_b{0, 0, 0};
    Vec3 axis_a{0, 0, 0}, axis_b{0, 0, 0};     ///< x axes of a gear's frames
    std::array<double, most_rows> impulses{};  ///< by row of the joint, N s or N m s
  };
  [[nodiscard]] static bool moves(const std::vector<blocks::IslandBody>& island, std::uint32_t place) {
    return place != 0 && island[place].movable;
  }
  [[nodiscard]] std::span<FigureGroup> groups() { return std::span(groups_).first(group_count_); }
  [[nodiscard]] std::span<const FigureGroup> groups() const { return std::span(groups_).first(group_count_); }
  /// Calls see(group, place, lane) for every joint.
  template <class See>
  void each(const See& see) const {
    for (const FigureGroup& group : groups())
      for (std::uint32_t place = 0; place < group.size(); ++place)
        for (int lane = 0; lane < group.lanes(); ++lane) see(group, place, lane);
  }
  /// Calls see(group) for every group; groups of whole figures, which have no body in common, run on all threads.
  /// @param backward  visits the others from the last to the first
  template <class See>
  void each_group(const See& see, bool backward = false) {
    const auto see_if = [&](std::size_t i, bool whole) {
      if (groups_[i].whole() == whole) see(groups_[i]);
    };
    work_.parts(group_count_, [&](std::size_t i) { see_if(i, true); });
    for (std::size_t i = 0; i < group_count_; ++i) see_if(backward ? group_count_ - 1 - i : i, false);
  }
  /// Joints that follow each other and belong to one figure, which is told by its first body.
  struct Run {
    std::uint32_t root, begin, end;
  };
  void find_figures(const std::vector<blocks::IslandBody>& island);
  void frame(FigureGroup& group, const std::vector<state::Body>& bodies, const std::vector<blocks::IslandBody>& island);
  void add_figure(const FigurePlan& plan, const FigureGroup::Shape& shape, bool whole);
  /// A plan that was made for figures connected in one way.
  struct KnownPlan {
    FigureGroup::Shape given;  ///< the shape, in the original order of the joints
    FigurePlan plan;
    FigureGroup::Shape shape;
    bool found = false;
  };
  KnownPlan& plan_for(std::span<const FigurePlan::Member> members);
  void end_sub_step(FigureGroup& group, const blocks::Lanes& kept);
  void unload(const FigureGroup& group, bool in_lanes, const blocks::Lanes& kept);
  void write(FigureGroup& group, const blocks::Lanes& live, const std::vector<state::Body>& bodies,
             const std::vector<blocks::IslandBody>& island, const std::vector<blocks::BodyLanes>& velocities);
  void write(Entry& entry, const std::vector<state::Body>& bodies, const std::vector<blocks::IslandBody>& island,
             const std::vector<blocks::BodyLanes>& velocities, JointRows& rows);
  void store();
  void close_gaps(FigureGroup& group, const std::vector<state::Body>& bodies, std::vector<blocks::IslandBody>& island,
                  const std::vector<blocks::BodyLanes>& velocities);

  std::vector<Entry> joints_;
  std::vector<FigureGroup> groups_;  ///< as many as any islands needed so far, since making one takes long
  std::size_t group_count_ = 0;
  std::vector<std::uint32_t> gears_;  ///< in joints_
  static constexpr std::size_t most_known = 8;
  std::vector<KnownPlan> known_;  ///< of figures seen lately
  std::size_t next_known_ = 0;    ///< the next one to be replaced
  FigurePlan plan_;
  FigurePlan::Room room_;
  FigureGroup::Shape shape_;
  std::vector<FigurePlan::Member> members_, given_;
  std::vector<Run> runs_;
  std::vector<std::uint32_t> kinds_;  ///< of joints_
  std::vector<std::uint32_t> roots_, local_;
  double h_ = 0, dt_ = 0, rate_ = 0;
  threads::Workers work_;
  bool closing_ = false;  ///< the step is over except for the remaining errors
};

}  // namespace tweenfall::joints
