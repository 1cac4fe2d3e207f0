#pragma once

#include <vector>

#include "forces/free_flight.h"
#include "step/contact_constraint.h"
#include "step/islands.h"
#include "step/keyed_step.h"

namespace tweenfall {

/// A body while contacts are being solved.
struct SolverBody {
  std::uint32_t index = 0;
  bool movable = false;
  bool impact = false;   ///< meets something in this step: its velocity jumps
  bool touched = false;  ///< an impulse reached it in this step
  bool pressed = false;  ///< an impulse reached it in this sub-step
  bool round = false;    ///< a ball: no contact can rock it
  bool stirred = false;  ///< by the rebound of this sub-step
  Vec3 lag{0, 0, 0};     ///< from the velocity at the end of the sub-step to its mean, m/s
  double roundness = 0;  ///< m
  double inverse_mass = 0;
  Mat3 inverse_inertia = Mat3::Zero();
  Vec3 center{0, 0, 0}, start_center{0, 0, 0};
  Quat rotation{1, 0, 0, 0}, start_rotation{1, 0, 0, 0};
  Quat turn{1, 0, 0, 0};  ///< from the start of the step to now
  Vec3 linear{0, 0, 0}, angular{0, 0, 0};
  KeyedCourse course;  ///< of an immovable body
  Vec3 drive_impulse{0, 0, 0}, drive_angular_impulse{0, 0, 0};
};

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
  /// Moves all bodies that `constraints` touch by `dt`; fills in the constraints' impulses.
  /// Afterwards `moved(index)` says whether a body was moved here.
  void solve(std::vector<Body>& bodies, const std::vector<Load>& loads, std::vector<ContactConstraint>& constraints,
             Islands& islands, const WorldSettings& settings, double dt);
  [[nodiscard]] bool moved(std::size_t index) const { return moved_[index] != 0; }

 private:
  void gather(const std::vector<Body>& bodies, std::vector<ContactConstraint>& constraints, double dt);
  void foresee(const std::vector<Load>& loads, ContactConstraint& constraint, double dt) const;
  void meet(const std::vector<Load>& loads, ContactConstraint& constraint, double h, double dt) const;
  void begin_sub_step(const std::vector<Body>& bodies, const std::vector<Load>& loads, const WorldSettings& settings,
                      double h, double share);
  void refresh(ContactConstraint& constraint) const;
  void warm_start(ContactConstraint& constraint, double h);
  double pass(std::vector<ContactConstraint>& constraints, const Softness& softness, double h, bool backward);
  double solve_contact(ContactConstraint& constraint, const Softness& softness, double h);
  double solve_drive(const std::vector<Body>& bodies, SolverBody& body, double h, double remaining);
  void find_lags(const std::vector<ContactConstraint>& constraints);
  void add_totals(std::vector<ContactConstraint>& constraints, double h);
  void end_sub_step(double h);

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
