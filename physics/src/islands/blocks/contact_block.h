#pragma once

/// Contacts of eight pairs that share no movable body, row by row.

#include <cstdint>
#include <span>

#include "islands/blocks/lanes.h"

namespace tweenfall::blocks {

/// What the rows change of a body: its velocity; and in another array how far it has come since the step began.
struct alignas(64) BodyLanes {
  double linear[4] = {};   ///< x, y, z and nothing
  double angular[4] = {};  ///< of a displacement: the sum of the turns, rad
};

/// From a body's velocity at the end of a sub-step to its mean, m/s.
struct alignas(32) BodyLag {
  double lanes[4] = {};  ///< x, y, z, and 1 where something presses on the body
};

/// One point of each pair along the normal.
struct PointRow {
  Lanes3 turn_a, turn_b;  ///< arm x normal
  Lanes mass;             ///< what a unit of speed takes, kg; 0 where a lane has no such point
  Lanes gap;              ///< at the start of the sub-step
  Lanes impulse;          ///< of the sub-step, N s
  Lanes lever;            ///< from the middle of the points, m
  Lanes base;             ///< gap before any displacement, m
  Lanes total;            ///< impulse of the step
};

/// Friction at a point, or for all of them at their middle.
struct FrictionRow {
  Lanes3 first_a, first_b, second_a, second_b;  ///< arm x tangent
  Lanes inverse11, inverse12, inverse22;        ///< from the slip to the impulse that stops it
  Lanes firm;                                   ///< from the slip to an impulse that never overshoots
  Lanes first, second;                          ///< impulses of the sub-step, N s
  Lanes total_first, total_second;
};

/// How the surfaces of the bodies move against each other at a row of friction, besides what the bodies do.
struct DriftRow {
  Lanes first, second;              ///< of b against a along the tangents, m/s
  Lanes later_first, later_second;  ///< once the bodies have been moved
  Lanes twist;                      ///< about the normal, rad/s
};

/// Of bodies that turn about some axes more easily than about others.
struct InertiaRow {
  LanesSymmetric inverse_a, inverse_b;
};

struct ContactBlock {
  std::uint32_t a[lane_count], b[lane_count];        ///< places of the bodies in the solver
  std::uint32_t to_a[lane_count], to_b[lane_count];  ///< where their velocities go: for a body that does not move to
                                                     ///< a place that nobody reads
  std::uint32_t point = 0, friction = 0;             ///< first rows
  std::uint32_t inertia = 0;                         ///< its row, where it is not even
  std::int8_t points = 0;                            ///< of the lane with most; what another has not has no mass
  std::int8_t frictions = 0;                         ///< none, one at the middle of several points, or as many
  bool drifts = false;                               ///< some surface moves: there are rows that tell how
  bool even = true;                                  ///< all bodies have one moment about every axis
  std::int8_t round_a[lane_count], round_b[lane_count];  ///< -1 for a ball: no contact can rock it
  Lanes3 normal, tangent1, tangent2;
  Lanes inverse_mass_a, inverse_mass_b;
  Lanes inverse_moment_a, inverse_moment_b;  ///< where it is even
  Lanes coefficient;                         ///< of friction
  Lanes twist_mass, twist, total_twist;      ///< about the normal, where friction is at the middle
  Mask hard;                                 ///< does not give way: an impact
  Mask pressed, held;                        ///< by an impulse in this sub-step; by friction that does not slide

  [[nodiscard]] bool central() const { return frictions == 1 && points > 1; }
};

/// Two balls, or one on something that stays where it is: what pushes along the line to the middle turns nothing.
struct BallBlock {
  std::uint32_t a[lane_count], b[lane_count];
  std::uint32_t to_a[lane_count], to_b[lane_count];
  Lanes3 normal;
  Lanes inverse_mass_a, inverse_mass_b;
  Lanes arm_a, arm_b;     ///< from the middles to the contact, m
  Lanes spin_a, spin_b;   ///< arm times inverse moment
  Lanes mass, slip_mass;  ///< along the normal, and across it
  Lanes gap, impulse;     ///< as of a PointRow
  Lanes3 friction;        ///< impulse of the sub-step, N s
  Lanes coefficient;
  Mask hard, pressed;
  Lanes base, total;
  Lanes3 total_friction;
};

/// How contacts may meet: see Closing.
struct MeetingRow {
  Lanes pull, tremble, restitution;
};

/// How an overlapping contact gives way in a pass, or in several: the same in all lanes.
struct PassRule {
  Lanes rate = all(0);       ///< share of the overlap that is taken apart, 1/s
  Lanes speed = all(0);      ///< at most, m/s
  Lanes firm = all(1);       ///< share of the speed error met
  Lanes keeping = all(1);    ///< share of the impulse kept
  Lanes inverse_h = all(0);  ///< of the sub-step, 1/s
  Lanes enough = all(0);  ///< of several passes, of the speed that the impulses give: a change that no longer matters
  int passes = 1;         ///< more than one only where no two lanes share a movable body
  bool note = false;      ///< notes what is pressed and held
  bool sum_up = false;    ///< adds the impulses to the totals
};

/// Rows of a whole island, and its bodies. What stands firm has the last word: contacts of one movable body come after
/// those of two.
struct Rows {
  ContactBlock* blocks = nullptr;
  std::size_t pairs = 0, count = 0;  ///< blocks with two movable bodies in each lane, and all
  BallBlock* balls = nullptr;
  std::size_t ball_pairs = 0, ball_count = 0;
  PointRow* points = nullptr;
  FrictionRow* frictions = nullptr;
  const DriftRow* drifts = nullptr;  ///< beside `frictions`; of blocks without any not read
  const InertiaRow* inertias = nullptr;
  const MeetingRow* meetings = nullptr;       ///< of blocks
  const MeetingRow* ball_meetings = nullptr;  ///< of balls
  BodyLanes* velocities = nullptr;
  const BodyLanes* displacements = nullptr;
  BodyLag* lags = nullptr;
};

/// Some blocks, or balls, of rows.
[[nodiscard]] inline Rows part_of(Rows rows, bool of_balls, std::size_t begin, std::size_t end) {
  rows.pairs = rows.count = of_balls ? 0 : end - begin;
  rows.ball_pairs = rows.ball_count = of_balls ? end - begin : 0;
  (of_balls ? rows.ball_meetings : rows.meetings) += begin;
  if (of_balls)
    rows.balls += begin;
  else
    rows.blocks += begin;
  return rows;
}

/// What is done with rows, for one instruction set. The bits do not depend on it.
struct Kernels {
  /// Gaps of the sub-step, and the impulses of the one before applied again.
  void (*warm_start)(const Rows& rows);
  /// Passes over each of the blocks: friction on the circular cone, then the normals.
  void (*solve)(const Rows& rows, const PassRule& rule);
  /// Takes out of the lags of what is pressed what a contact holds: along the normal, or all of it.
  void (*hold)(const Rows& rows);
  /// Finds what may meet in the sub-step fast enough to rebound: lanes as 8 * block + lane, in order; balls after all
  /// blocks.
  /// `starts`: velocities at the start of the sub-step; `found`: room for all lanes. Returns how many.
  std::size_t (*find_meetings)(const Rows& rows, const BodyLanes* starts, double h, std::uint32_t* found);
};

/// For all instruction sets that this processor has, the plainest first and the widest last.
[[nodiscard]] std::span<const Kernels* const> possible_kernels();
/// The last of them.
[[nodiscard]] const Kernels& fastest_kernels();

}  // namespace tweenfall::blocks
