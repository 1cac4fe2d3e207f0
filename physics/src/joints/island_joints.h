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

/// The joints of islands in sub-steps: errors are taken apart while bodies move, and the speed of that is taken away
/// again. What hangs together by joints is solved at once: what holds, and of what bounds or drives all that is not at
/// its bound.
/// Sources: Macklin and others, Small Steps in Physics Simulation, SCA 2019; Catto, Solver2D, 2024 (relaxation);
/// Cottle, Pang and Stone, The Linear Complementarity Problem, 1992 (rows change places by the signs that come out).
class IslandJoints {
 public:
  /// Begins with the impulses that the joints kept.
  /// @param places  from a body's index to its place in the island; 0 for none, and for the world
  void build(std::span<JointLink* const> links, const std::vector<state::Body>& bodies,
             const std::vector<std::uint32_t>& places, const std::vector<blocks::IslandBody>& island, double h,
             double dt, const threads::Workers& workers);
  [[nodiscard]] bool empty() const { return joints_.empty(); }

  /// Rows for the bodies as they stand, and the impulses of the sub-step before applied again.
  /// @param starts  velocities with which the sub-step begins
  void begin_sub_step(const std::vector<state::Body>& bodies, const std::vector<blocks::IslandBody>& island,
                      const std::vector<blocks::BodyLanes>& starts, std::vector<blocks::BodyLanes>& velocities);
  /// One pass over all joints, forward or backward.
  /// @param moving  errors are being taken apart
  void solve(std::vector<blocks::BodyLanes>& velocities, bool moving, bool backward);
  /// Marks the bodies that a joint acts on in this sub-step. Calls `anchored(place)` for those on which one acts that
  /// ends in something that nothing moves.
  template <class Anchored>
  void find_held(std::vector<blocks::IslandBody>& island, const Anchored& anchored) const {
    each([&](const FigureGroup& group, std::uint32_t place, int lane) {
      if (!group.acts(place, lane)) return;
      const Entry& entry = joints_[group.joint(place, lane)];
      island[entry.a].jointed = island[entry.b].jointed = true;
      // Pulleys are held by nothing that moves.
      const bool hangs = std::holds_alternative<PulleyJoint>(entry.joint->settings.kind);
      if (hangs || !moves(island, entry.a)) anchored(entry.b);
      if (hangs || !moves(island, entry.b)) anchored(entry.a);
    });
  }
  /// Calls `acts(place, place)` for both ends of the joints that act in this sub-step.
  template <class Acts>
  void each_acting(const Acts& acts) const {
    each([&](const FigureGroup& group, std::uint32_t place, int lane) {
      const Entry& entry = joints_[group.joint(place, lane)];
      if (group.acts(place, lane)) acts(entry.a, entry.b);
    });
  }
  /// The bodies move with these velocities.
  void move(const std::vector<blocks::BodyLanes>& velocities);
  /// Adds up what the sub-step did.
  void end_sub_step();
  /// Begins the next sub-step without impulses of joints on bodies for which `wild(place)` holds.
  template <class Wild>
  void forget(const Wild& wild) {
    for (FigureGroup& group : groups())
      for (int lane = 0; lane < group.lanes(); ++lane)
        if (wild(group.moving_body(lane))) group.forget(lane);
  }
  /// Gives impulses, forces and torques back to the joints, takes what is left of errors away by moving the bodies, and
  /// gives them velocities that fit the places where the step ends.
  void end_step(const std::vector<state::Body>& bodies, std::vector<blocks::IslandBody>& island,
                std::vector<blocks::BodyLanes>& velocities);

 private:
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
  /// Calls see(group) for every group: for those of whole figures, which have no body in common, on all threads.
  /// @param backward  the others from the last to the first
  template <class See>
  void each_group(const See& see, bool backward = false) {
    const auto see_if = [&](std::size_t i, bool whole) {
      if (groups_[i].whole() == whole) see(groups_[i]);
    };
    work_.parts(group_count_, [&](std::size_t i) { see_if(i, true); });
    for (std::size_t i = 0; i < group_count_; ++i) see_if(backward ? group_count_ - 1 - i : i, false);
  }
  void find_figures(const std::vector<blocks::IslandBody>& island);
  void frame(FigureGroup& group, const std::vector<state::Body>& bodies, const std::vector<blocks::IslandBody>& island);
  void add_figure(const FigurePlan& plan, const FigureGroup::Shape& shape, bool whole);
  /// A plan that was made for figures that hang together in one way.
  struct KnownPlan {
    FigureGroup::Shape given;  ///< how: as a shape, in the order in which the joints were
    FigurePlan plan;
    FigureGroup::Shape shape;
    bool found = false;
  };
  KnownPlan& plan_for(std::span<const FigurePlan::Member> members);
  void unload(const FigureGroup& group, bool in_lanes);
  void write(FigureGroup& group, const blocks::Lanes& live, const std::vector<state::Body>& bodies,
             const std::vector<blocks::IslandBody>& island, const std::vector<blocks::BodyLanes>& velocities);
  void write(Entry& entry, const std::vector<state::Body>& bodies, const std::vector<blocks::IslandBody>& island,
             const std::vector<blocks::BodyLanes>& velocities, JointRows& rows);
  void store();
  void close_gaps(FigureGroup& group, const std::vector<state::Body>& bodies, std::vector<blocks::IslandBody>& island,
                  const std::vector<blocks::BodyLanes>& velocities);

  std::vector<Entry> joints_;
  std::vector<FigureGroup> groups_;  ///< of the islands with most so far: one takes long to make
  std::size_t group_count_ = 0;
  std::vector<std::uint32_t> gears_;  ///< of joints_
  static constexpr std::size_t most_known = 8;
  std::vector<KnownPlan> known_;  ///< those of figures seen lately
  std::size_t next_known_ = 0;    ///< gives way to the next one
  FigurePlan plan_;
  FigurePlan::Room room_;
  FigureGroup::Shape shape_;
  std::vector<FigurePlan::Member> members_, given_;
  std::vector<std::uint64_t> sorted_;  ///< roots of members, and which ones
  std::vector<std::uint32_t> kinds_;   ///< of joints_
  std::vector<std::uint32_t> roots_, local_;
  double h_ = 0, dt_ = 0, rate_ = 0;
  threads::Workers work_;
  bool closing_ = false;  ///< the step is over but for the errors that are left
};

}  // namespace tweenfall::joints
