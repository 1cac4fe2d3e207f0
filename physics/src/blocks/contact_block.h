#pragma once

/// Contacts of four pairs that share no movable body, row by row.

#include <cstdint>

#include "blocks/lanes.h"

namespace tweenfall::step {
struct ContactConstraint;
}

namespace tweenfall::blocks {

/// What the rows change of a body: its velocity; and in another array how far it has come since the step began.
struct alignas(64) BodyLanes {
  double linear[4] = {};   ///< x, y, z and nothing
  double angular[4] = {};  ///< of a displacement: the sum of the turns, rad
};

/// One point of each pair along the normal.
struct PointRow {
  Lanes3 turn_a, turn_b;  ///< arm x normal
  Lanes mass;             ///< what a unit of speed takes, kg; 0 where a lane has no such point
  Lanes base;             ///< gap before any displacement, m
  Lanes gap;              ///< at the start of the sub-step
  Lanes impulse;          ///< of the sub-step, N s
  Lanes total;            ///< of the step
  Lanes lever;            ///< from the middle of the points, m
  Lanes rebound;          ///< speed wanted at the end of the sub-step, m/s
};

/// Friction at a point, or for all of them at their middle.
struct FrictionRow {
  Lanes3 first_a, first_b, second_a, second_b;  ///< arm x tangent
  Lanes inverse11, inverse12, inverse22;        ///< from the slip to the impulse that stops it
  Lanes firm;                                   ///< from the slip to an impulse that never overshoots
  Lanes first, second;                          ///< impulses of the sub-step, N s
  Lanes total_first, total_second;
};

struct ContactBlock {
  std::uint32_t a[lane_count], b[lane_count];     ///< places of the bodies in the solver
  step::ContactConstraint* contacts[lane_count];  ///< null for an empty lane
  std::uint32_t point = 0, friction = 0;          ///< first rows
  std::int32_t points = 0;                        ///< of the lane with most
  std::int32_t frictions = 0;                     ///< none, one at the middle of several points, or as many as points
  Lanes3 normal, tangent1, tangent2;
  Lanes inverse_mass_a, inverse_mass_b;
  LanesSymmetric inverse_inertia_a, inverse_inertia_b;
  Lanes coefficient;                     ///< of friction
  Lanes twist_mass, twist, total_twist;  ///< about the normal, where friction is at the middle
  Lanes pull, tremble, restitution;      ///< see Closing
  Mask hard;                             ///< does not give way: an impact
  Mask pressed, held;                    ///< by an impulse in this sub-step; by friction that does not slide

  [[nodiscard]] bool central() const { return frictions == 1 && points > 1; }
};

/// How an overlapping contact gives way in a pass.
struct PassRule {
  double rate = 0;       ///< share of the overlap that is taken apart, 1/s
  double speed = 0;      ///< at most, m/s
  double firm = 1;       ///< share of the speed error met
  double keeping = 1;    ///< share of the impulse kept
  double inverse_h = 0;  ///< of the sub-step, 1/s
  bool note = false;     ///< notes what is pressed and held
  bool sum_up = false;   ///< adds the impulses to the totals
};

/// Rows of a whole island, and its bodies.
struct Rows {
  ContactBlock* blocks = nullptr;
  std::size_t count = 0;
  PointRow* points = nullptr;
  FrictionRow* frictions = nullptr;
  BodyLanes* velocities = nullptr;
  const BodyLanes* displacements = nullptr;
};

/// What is done with rows, for one instruction set. The bits do not depend on it.
struct Kernels {
  /// Gaps of the sub-step, and the impulses of the one before applied again.
  void (*warm_start)(const Rows& rows);
  /// One pass over all blocks: friction on the circular cone, then the normals.
  void (*solve)(const Rows& rows, const PassRule& rule);
  /// Finds what may meet in the sub-step fast enough to rebound: lanes as 4 * block + lane, in order.
  /// `starts`: velocities at the start of the sub-step; `found`: room for all lanes. Returns how many.
  std::size_t (*find_meetings)(const Rows& rows, const BodyLanes* starts, double h, std::uint32_t* found);
};

[[nodiscard]] const Kernels& plain_kernels();
/// The widest that this processor has.
[[nodiscard]] const Kernels& fastest_kernels();

}  // namespace tweenfall::blocks
