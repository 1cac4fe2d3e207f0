#pragma once

#include "step/solver_body.h"

namespace tweenfall::step {

/// A spring too stiff for the step to be taken explicitly: its force is that at the end of each sub-step, so that no
/// stiffness and no step can make it grow. It damps motions faster than a sub-step.
/// Sources: Baraff and Witkin, Large Steps in Cloth Simulation, SIGGRAPH 1998; Catto, Soft Constraints, GDC 2011.
struct SpringRow {
  static constexpr std::uint32_t world = 0xffffffffu;
  std::uint32_t a = world, b = world;       ///< indices of the bodies
  Vec3 local_a{0, 0, 0}, local_b{0, 0, 0};  ///< from the center of mass, node axes; for the world, b's in world axes
  double rest_length = 0, stiffness = 0, damping = 0;

  Vec3 arm_a{0, 0, 0}, arm_b{0, 0, 0};
  Vec3 pull{0, 0, 0};                ///< of the spring at the start of the sub-step, on a, N s
  Mat3 give = Mat3::Zero();          ///< loss of impulse per unit of the ends' relative velocity at the end, kg
  Mat3 solution = Mat3::Zero();      ///< from the wanted velocity to the impulse
  Mat3 inverse_mass = Mat3::Zero();  ///< of the two ends relative to each other, 1/kg
  Vec3 impulse{0, 0, 0};             ///< on a, N s

  /// Updates the row to the bodies' positions and applies the impulse of the sub-step before.
  void begin(SolverBody* body_a, SolverBody* body_b, double h);
  /// @return the change of velocity, m/s
  double solve(SolverBody* body_a, SolverBody* body_b);
};

}  // namespace tweenfall::step
