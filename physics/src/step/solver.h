#pragma once

#include <span>
#include <vector>

#include "forces/free_flight.h"
#include "step/contact_constraint.h"
#include "step/solver_body.h"
#include "step/spring_row.h"

namespace tweenfall {

/// How an overlapping contact gives way while positions are corrected.
struct Softness {
  double rate = 0;    ///< share of the overlap that is taken apart, 1/s
  double speed = 0;   ///< at most, m/s
  double firm = 1;    ///< share of the speed error met by a pass
  double giving = 0;  ///< share of the impulse let go by a pass
};

/// A body at the start of a sub-step, and before its rebound.
struct SubStepStart {
  Vec3 linear, angular, center;
  Quat rotation;
  Vec3 linear_before_rebound, angular_before_rebound;
};

/// Sequential impulses in sub-steps. Overlap is taken apart by soft contacts that move positions; hard passes then
/// take the speed of that away again, so that it moves bodies and gives them no energy. Rebound follows in the sub-step
/// of the impact, from the approach speed there, and never leaves an island more energy than it had.
/// Sources: Catto, Fast and Simple Physics using Sequential Impulses, GDC 2006; Macklin and others,
/// Small Steps in Physics Simulation, SCA 2019; Catto, Solver2D, 2024 (soft contacts and relaxation).
class Solver {
 public:
  using Contacts = std::span<ContactConstraint* const>;
  using Springs = std::span<SpringRow* const>;

  /// Before the islands of a step: no body was moved yet.
  void begin(std::size_t bodies);
  /// Moves all bodies of one island that `contacts` touch or `springs` hold by `dt`; fills in the contacts' impulses.
  /// Afterwards `moved(index)` says whether a body was moved here.
  /// @param springs  those too stiff to be part of the loads
  void solve(std::vector<Body>& bodies, const std::vector<Load>& loads, Contacts contacts, Springs springs,
             const WorldSettings& settings, double dt);
  [[nodiscard]] bool moved(std::size_t index) const { return moved_[index] != 0; }

 private:
  void gather(const std::vector<Body>& bodies, Contacts contacts, Springs springs, double dt);
  void foresee(const std::vector<Load>& loads, ContactConstraint& constraint, double dt) const;
  void meet(const std::vector<Load>& loads, ContactConstraint& constraint, double h, double dt) const;
  void begin_sub_step(const std::vector<Body>& bodies, const std::vector<Load>& loads, const WorldSettings& settings,
                      double h, int sub_step);
  void refresh(ContactConstraint& constraint) const;
  void warm_start(ContactConstraint& constraint, double h);
  double pass(Contacts contacts, const Softness& softness, double h, bool backward);
  double solve_contact(ContactConstraint& constraint, const Softness& softness, double h);
  double solve_drive(const std::vector<Body>& bodies, SolverBody& body, double h, double remaining);
  void find_lags(Contacts contacts);
  void add_totals(Contacts contacts, double h);
  void end_sub_step(double h);
  void bound_spins(const std::vector<Body>& bodies, double h);

  // Rebound
  void rebound(const std::vector<Body>& bodies, const std::vector<Load>& loads, Contacts contacts, int passes);
  double rebound_pass(Contacts contacts, bool backward);
  void move_by_rebound(const ContactConstraint& constraint);
  void bound_energy(const std::vector<Body>& bodies, const std::vector<Load>& loads, Contacts contacts);

  SolverBody* end_of(std::uint32_t index) { return index == SpringRow::world ? nullptr : &at(index); }
  SolverBody& at(std::uint32_t index) { return bodies_[slots_[index]]; }
  const SolverBody& at(std::uint32_t index) const { return bodies_[slots_[index]]; }

  std::vector<SolverBody> bodies_;
  std::vector<std::uint32_t> slots_;  ///< from a body's index into bodies_
  std::vector<char> moved_;
  std::vector<SubStepStart> starts_;  ///< of bodies_
};

}  // namespace tweenfall
