#pragma once

#include <tweenfall/physics/planar_world.h>

#include <vector>

#include "planar/body.h"
#include "planar/contacts/contact_solver.h"
#include "planar/contacts/depth.h"
#include "planar/contacts/near_pairs.h"
#include "state/lazily_made.h"

namespace tweenfall::planar {

namespace inner {

/// Where a joint holds a body, and how that point moves.
struct JointEnd {
  Vec2 at, velocity;  ///< m, m/s
  double angle = 0, spin = 0;
};

/// Two bodies, or parts of them, that touched in the last step.
struct Touch {
  BodyId a, b;
  std::uint32_t meeting = 0;  ///< of the world's
  std::uint32_t given = 0;    ///< of the solver's
  bool solved = false;        ///< in the last step; a sleeping pair is not
  bool began = false;
};

}  // namespace inner

struct World::Implementation {
  WorldSettings settings;
  double time = 0;
  std::vector<inner::Body> bodies;  ///< by index; those of removed bodies are not alive
  std::vector<inner::Makeup> makeups;
  std::vector<std::uint32_t> unused;  ///< indices, the last removed last
  std::vector<inner::Joint> joints;
  std::vector<std::uint32_t> unused_joints;
  std::vector<inner::Pair> ignored;      ///< sorted
  std::vector<inner::Meeting> meetings;  ///< sorted
  double last_h = 0;                     ///< length of the last sub-step whose impulses are kept, s
  double passed_over = 0;                ///< time since then, in steps too short to keep their impulses, s
  bool failed = false;                   ///< a body is not finite

  // What follows from these
  std::vector<inner::Pair> kept_apart;  ///< by joints, or by `ignore`, sorted
  inner::NearPairs near;
  std::size_t sleepers = 0;

  // Of the last step
  std::vector<inner::Touch> touches, touches_before;
  std::vector<EndedContact> ended;
  std::vector<SensorOverlap> overlaps;
  int sub_steps = 0;

  /// What the caller sees of the contacts, until bodies are moved or removed: they are told then, if they were not.
  state::LazilyMade<std::vector<Contact>> told;

  // Memory for a step
  double step_length = 0;             ///< s
  std::vector<std::uint32_t> moving;  ///< bodies under way
  std::vector<std::uint32_t> active;  ///< meetings with points to be solved
  std::vector<char> looked_at;        ///< by meeting
  std::vector<std::uint32_t> root;    ///< of islands
  std::vector<double> stillness;
  std::vector<char> held;    ///< by body: something touches it or is joined to it
  std::vector<Vec2> starts;  ///< centers
  std::vector<double> start_angles;
  inner::Depth depth;
  inner::ContactSolver solver;

  [[nodiscard]] inner::Body& at(BodyId id);  ///< @throws std::invalid_argument
  [[nodiscard]] const inner::Body& at(BodyId id) const;
  [[nodiscard]] BodyId handle(std::uint32_t index) const { return {index, makeups[index].generation}; }
  [[nodiscard]] inner::Joint& at(JointId id);
  [[nodiscard]] const inner::Joint& at(JointId id) const;
  [[nodiscard]] inner::JointEnd end_of(BodyId body, const Vec2& anchor) const;  ///< no body: the world
  [[nodiscard]] Motion motion_of(std::uint32_t index) const;
  void place(std::uint32_t index, const Motion& motion);
  void give_mass(std::uint32_t index);  ///< sets its inverse masses
  void wake(std::uint32_t index);
  void wake_neighbors(std::uint32_t index);
  void keep_apart();  ///< updates `kept_apart`
  void look_again(std::uint32_t index);
  void meet_or_not(const inner::Pair& pair);
  void settle_in();  ///< after loading

  void step(double dt, double parts);
  void set_out(double dt);
  void damp(std::uint32_t index, double h);  ///< applies the damping of a sub-step
  void find_meetings(double dt);
  void look_at(inner::Meeting& meeting, double dt);
  bool rouse();
  void join_islands();
  [[nodiscard]] std::uint32_t root_of(std::uint32_t index);
  void arrive(double dt);
  void report();
  void report(std::uint32_t index, bool solved, std::uint32_t given);
  [[nodiscard]] const std::vector<Contact>& contacts() const;
  [[nodiscard]] Contact contact_of(const inner::Touch& touch) const;
  void recall(const std::vector<Contact>& contacts);  ///< as they were told
  void sense();
  void note_starts();
  void let_sleep(double dt);
  void forget_forces();
  /// Whether the pull on a sleeping body is that with which it fell asleep.
  [[nodiscard]] bool bears_the_same(const inner::Body& body) const;
  [[nodiscard]] inner::BodyRow gain_of(const inner::Body& body) const;
  void hold_in_the_air();  ///< a body that a force pulls and nothing holds is not still
  void check_finite(double dt);
};

}  // namespace tweenfall::planar
