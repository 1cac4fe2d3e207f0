#pragma once

#include <functional>
#include <span>
#include <vector>

#include "forces/free_flight.h"
#include "islands/small/extrapolation.h"
#include "step/contact_rows.h"
#include "step/keyed_step.h"
#include "step/softness.h"
#include "step/solved_contact.h"
#include "step/solver_body.h"
#include "step/spring_row.h"

namespace tweenfall::step {

/// A body at the start of a sub-step, and before its rebound.
struct SubStepStart {
  Vec3 linear, angular, center;
  Quat rotation;
  Vec3 linear_before_rebound, angular_before_rebound;
};

/// What two bodies exchanged at one instant.
struct Blow {
  contacts::ContactConstraint* contact = nullptr;
  Vec3 impulse{0, 0, 0};  ///< on the second body, N s
  double normal = 0;      ///< N s
  double approach = 0;    ///< greatest closing speed, m/s
};

/// Sequential impulses in sub-steps. Overlap is removed by soft contacts that move positions; hard passes then remove
/// the speed this gave, so that it moves bodies but gives them no energy. Rebound follows in the sub-step
/// of the impact, from the approach speed there, and never leaves an island with more energy than it had.
/// Sources: Catto, Fast and Simple Physics using Sequential Impulses, GDC 2006; Macklin and others,
/// Small Steps in Physics Simulation, SCA 2019; Catto, Solver2D, 2024 (soft contacts and relaxation).
class Solver {
 public:
  using Springs = std::span<SpringRow* const>;
  /// Per step; the passes are distributed over them.
  static constexpr int usual_sub_steps = 8;
  /// An island with up to this many contacts is solved to the end.
  static constexpr std::size_t to_the_end = 32;

  /// Before the islands of a step. @param parts  length of the whole step divided by that of this one
  void begin(std::size_t bodies, double parts);
  /// Moves those bodies of one island that `contacts` touch or `springs` hold by `dt`; fills in the contacts' impulses.
  /// @param springs  those too stiff to be part of the loads
  /// @param moved  by index: set for the bodies that were moved
  /// @param rough  the usual passes are enough, also where a few more would find what rests to the last bit
  void solve(std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads,
             std::span<contacts::ContactConstraint* const> contacts, Springs springs, const WorldSettings& settings,
             double dt, std::vector<char>& moved, int sub_steps = usual_sub_steps, bool rough = false);
  /// Lets the bodies of a small island strike each other where they touch and close noticeably: the hardest
  /// blow first, each between two bodies alone (equal blows all at once), until none is left. Momentum is kept, and
  /// energy never grows; at restitution 1 without friction it is kept.
  const std::vector<Blow>& strike(std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads,
                                  std::span<contacts::ContactConstraint* const> contacts, double dt);

 private:
  using Contacts = std::span<SolvedContact>;

  void gather(const std::vector<state::Body>& bodies, std::span<contacts::ContactConstraint* const> contacts,
              Springs springs, double dt);
  void meet(const std::vector<forces::Load>& loads, SolvedContact& constraint, double h, double whole) const;
  void begin_sub_step(const std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads,
                      const WorldSettings& settings, double h, int sub_step);
  void lead(double h, int sub_step);
  void ride(const SolvedContact& constraint, const SolvedPoint& point, PointRows& rows, double h) const;
  void end_lead();
  static void level(SolvedContact& constraint);
  void refresh(SolvedContact& constraint) const;
  void warm_start(SolvedContact& constraint, PointRows* rows, const Softness& softness, double h);
  double pass(Contacts contacts, const Softness& softness, double h, bool backward);
  double solve_contact(SolvedContact& constraint, const PointRows* rows, const Softness& softness, double h);
  /// Makes passes until one changes nothing: at most `passes`, or as many as needed if the island is small.
  void settle(int passes, const std::function<double(bool backward)>& pass);
  /// The normal impulses that reach the speeds the last pass aimed at, with friction as it is.
  void press_at_once(SolvedContact& contact, const PointRows* rows);
  [[nodiscard]] bool extrapolates(const std::vector<state::Body>& bodies, Springs springs) const;
  void read_impulses(std::vector<double>& impulses) const;
  void read_holds(std::vector<char>& holds) const;
  void set_impulses(const std::vector<double>& impulses);
  double solve_drive(const std::vector<state::Body>& bodies, SolverBody& body, double h, double remaining);
  void find_lags(Contacts contacts);
  void add_totals(Contacts contacts, double h);
  void end_sub_step(double h);
  void carry_spins(const std::vector<state::Body>& bodies, double h);
  void bound_spins(const std::vector<state::Body>& bodies, double h);

  // Rebound
  void rebound(const std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads, Contacts contacts,
               int passes);
  double rebound_pass(Contacts contacts, bool backward);
  void move_by_rebound(const SolvedContact& constraint, const PointRows* rows);
  void bound_energy(const std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads, Contacts contacts);

  // Blows
  [[nodiscard]] double closing_speed(const SolvedContact& contact) const;
  void strike_at_once(std::span<const std::size_t> numbers);

  SolverBody* end_of(std::uint32_t index) { return index == SpringRow::world ? nullptr : &at(index); }
  SolverBody& at(std::uint32_t index) { return bodies_[slots_[index]]; }
  const SolverBody& at(std::uint32_t index) const { return bodies_[slots_[index]]; }

  std::vector<SolverBody> bodies_;
  std::vector<std::uint32_t> slots_;     ///< from a body's index into bodies_
  std::vector<SubStepStart> starts_;     ///< of bodies_
  std::vector<LedBody> led_;             ///< of bodies_
  std::vector<SolvedContact> contacts_;  ///< of the island
  std::vector<PointRows> rows_;          ///< four per contact of the island
  int sub_steps_ = usual_sub_steps;
  double parts_ = 1;
  double heaviest_ = 0, lightest_ = 0;  ///< of the island, kg
  bool extrapolating_ = false;
  small::Extrapolation extrapolation_;
  std::vector<double> from_, to_, best_;  ///< impulses before and after a pass, and those that a pass changed least
  std::vector<Blow> blows_;
  double touching_ = 0;             ///< gap up to which points may strike each other, m
  std::vector<char> holds_, held_;  ///< after a pass and after the one before it
};

}  // namespace tweenfall::step
