#pragma once

#include <vector>

#include "forces/free_flight.h"
#include "step/contact_constraint.h"
#include "step/islands.h"
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

/// Energy of an island through a sub-step, J.
struct IslandEnergy {
  double limit = 0;                              ///< what it may have after: what it had, and the work done on it
  double without = 0, slope = 0, curvature = 0;  ///< kinetic, by the share of the rebound that is let through
};

/// Sequential impulses in sub-steps. Overlap is taken apart by soft contacts that move positions; hard passes then
/// take the speed of that away again, so that it moves bodies and gives them no energy. Rebound follows in the sub-step
/// of the impact, from the approach speed there, and never leaves an island more energy than it had.
/// Sources: Catto, Fast and Simple Physics using Sequential Impulses, GDC 2006; Macklin and others,
/// Small Steps in Physics Simulation, SCA 2019; Catto, Solver2D, 2024 (soft contacts and relaxation).
class Solver {
 public:
  /// Moves all bodies that `constraints` touch or `springs` hold by `dt`; fills in the constraints' impulses.
  /// Afterwards `moved(index)` says whether a body was moved here.
  /// @param springs  those too stiff to be part of the loads
  void solve(std::vector<Body>& bodies, const std::vector<Load>& loads, std::vector<ContactConstraint>& constraints,
             std::vector<SpringRow>& springs, Islands& islands, const WorldSettings& settings, double dt);
  [[nodiscard]] bool moved(std::size_t index) const { return moved_[index] != 0; }

 private:
  void gather(const std::vector<Body>& bodies, std::vector<ContactConstraint>& constraints,
              const std::vector<SpringRow>& springs, double dt);
  void foresee(const std::vector<Load>& loads, ContactConstraint& constraint, double dt) const;
  void meet(const std::vector<Load>& loads, ContactConstraint& constraint, double h, double dt) const;
  void begin_sub_step(const std::vector<Body>& bodies, const std::vector<Load>& loads, const WorldSettings& settings,
                      double h, int sub_step);
  void refresh(ContactConstraint& constraint) const;
  void warm_start(ContactConstraint& constraint, double h);
  double pass(std::vector<ContactConstraint>& constraints, const Softness& softness, double h, bool backward);
  double solve_contact(ContactConstraint& constraint, const Softness& softness, double h);
  double solve_drive(const std::vector<Body>& bodies, SolverBody& body, double h, double remaining);
  void find_lags(const std::vector<ContactConstraint>& constraints);
  void add_totals(std::vector<ContactConstraint>& constraints, double h);
  void end_sub_step(double h);
  void bound_spins(const std::vector<Body>& bodies, double h);

  // Rebound
  void rebound(const std::vector<Body>& bodies, const std::vector<Load>& loads,
               std::vector<ContactConstraint>& constraints, Islands& islands, int passes);
  bool find_rebounds(std::vector<ContactConstraint>& constraints, Islands& islands);
  double rebound_pass(std::vector<ContactConstraint>& constraints, bool backward);
  void move_by_rebound(const ContactConstraint& constraint);
  void bound_energy(const std::vector<Body>& bodies, const std::vector<Load>& loads,
                    std::vector<ContactConstraint>& constraints, Islands& islands);
  [[nodiscard]] std::uint32_t island_of(const ContactConstraint& constraint, Islands& islands) const {
    return islands.of(at(constraint.a).movable ? constraint.a : constraint.b);
  }

  SolverBody* end_of(std::uint32_t index) { return index == SpringRow::world ? nullptr : &at(index); }
  SolverBody& at(std::uint32_t index) { return bodies_[slots_[index]]; }
  const SolverBody& at(std::uint32_t index) const { return bodies_[slots_[index]]; }

  std::vector<SolverBody> bodies_;
  std::vector<std::uint32_t> slots_;  ///< from a body's index into bodies_
  std::vector<char> moved_;
  std::vector<char> flags_;
  std::vector<SubStepStart> starts_;  ///< of bodies_
  std::vector<IslandEnergy> energies_;
};

}  // namespace tweenfall
