#pragma once

#include <span>
#include <vector>

#include "blocks/contact_block.h"
#include "blocks/island_body.h"
#include "joints/joint_link.h"
#include "joints/joint_rows.h"
#include "joints/joint_system.h"

namespace tweenfall::joints {

/// The joints of an island in sub-steps: errors are taken apart while bodies move, and the speed of that is taken away
/// again. What hangs together by joints is solved at once: what holds, and of what bounds or drives all that is not at
/// its bound.
/// Sources: Macklin and others, Small Steps in Physics Simulation, SCA 2019; Catto, Solver2D, 2024 (relaxation);
/// Cottle, Pang and Stone, The Linear Complementarity Problem, 1992 (rows change places by the signs that come out).
class IslandJoints {
 public:
  /// Begins with the impulses that the joints kept.
  /// @param places  from a body's index to its place in the island; 0 for none, and for the world
  void build(std::span<JointLink* const> links, const std::vector<std::uint32_t>& places,
             const std::vector<blocks::IslandBody>& island, double h, double dt);
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
    for (const Entry& entry : joints_) {
      if (!entry.acts()) continue;
      island[entry.a].jointed = island[entry.b].jointed = true;
      if (!moves(island, entry.a)) anchored(entry.b);
      if (!moves(island, entry.b)) anchored(entry.a);
    }
  }
  /// The bodies move with these velocities.
  void move(const std::vector<blocks::BodyLanes>& velocities);
  /// Adds up what the sub-step did.
  void add_up();
  /// Begins the next sub-step without impulses of joints on bodies for which `wild(place)` holds.
  template <class Wild>
  void forget(const std::vector<blocks::IslandBody>& island, const Wild& wild) {
    for (Entry& entry : joints_)
      if (wild(moves(island, entry.a) ? entry.a : entry.b)) entry.rows.impulses.fill(0);
  }
  /// Gives impulses, forces and torques back to the joints, takes what is left of errors away by moving the bodies, and
  /// gives them velocities that fit the places where the step ends.
  void end_step(const std::vector<state::Body>& bodies, std::vector<blocks::IslandBody>& island,
                std::vector<blocks::BodyLanes>& velocities);

 private:
  struct Entry {
    state::Joint* joint = nullptr;
    std::uint32_t a = 0, b = 0;  ///< places
    double inverse_mass_a = 0, inverse_mass_b = 0;
    Vec3 arm_b{0, 0, 0};
    Vec3 axis_a{0, 0, 0}, axis_b{0, 0, 0};  ///< x axes of the frames
    Vec3 push{0, 0, 0}, turn{0, 0, 0};      ///< on b in the step so far, N s and N m s
    JointRows rows;

    [[nodiscard]] bool acts() const {
      for (std::size_t i = 0; i < rows.count; ++i)
        if (rows.impulses[i] != 0) return true;
      return false;
    }
  };
  [[nodiscard]] static bool moves(const std::vector<blocks::IslandBody>& island, std::uint32_t place) {
    return place != 0 && island[place].movable;
  }
  /// Joints that hang together.
  struct Figure {
    JointSystem system;
    bool stale = true;     ///< its factors are of other rows
    bool bounded = false;  ///< some row that is in has bounds
  };
  /// What is left of a row's speed, m/s or rad/s.
  static double lack(const Entry& entry, std::size_t slot, bool moving,
                     const std::vector<blocks::BodyLanes>& velocities);
  void find_figures(const std::vector<blocks::IslandBody>& island);
  void write(const std::vector<state::Body>& bodies, const std::vector<blocks::IslandBody>& island,
             const std::vector<blocks::BodyLanes>& velocities);
  void write(Entry& entry, const std::vector<state::Body>& bodies, const std::vector<blocks::IslandBody>& island,
             const std::vector<blocks::BodyLanes>& velocities) const;
  void store();
  void close_gaps(const std::vector<state::Body>& bodies, std::vector<blocks::IslandBody>& island,
                  const std::vector<blocks::BodyLanes>& velocities);
  double close_gaps(Figure& figure, std::vector<blocks::IslandBody>& island, bool of_what_holds);
  void solve(Figure& figure, std::vector<blocks::BodyLanes>& velocities, bool moving);
  void solve_in(Figure& figure, std::vector<blocks::BodyLanes>& velocities, bool moving);
  bool admit(Figure& figure, const std::vector<blocks::BodyLanes>& velocities, bool moving);
  bool dismiss(Figure& figure, std::vector<blocks::BodyLanes>& velocities, bool all);
  static void apply(const Entry& entry, const Row& row, double impulse, std::vector<blocks::BodyLanes>& velocities);

  std::vector<Entry> entries_;  ///< of the island with most joints so far: one takes long to make
  std::span<Entry> joints_;
  std::vector<Figure> figures_;
  std::size_t figure_count_ = 0;
  std::vector<blocks::BodyLanes> moves_;  ///< by place, while gaps are being closed
  JointSystem::Plans plans_;
  std::vector<JointSystem::Member> members_, together_;
  std::vector<std::uint32_t> roots_, figure_of_, firsts_;
  double h_ = 0, dt_ = 0, rate_ = 0;
};

}  // namespace tweenfall::joints
