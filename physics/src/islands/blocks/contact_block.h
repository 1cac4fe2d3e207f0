#pragma once

/// Contacts of eight pairs that share no movable body, row by row.

#include <array>
#include <cstdint>
#include <span>

#include "islands/blocks/lanes.h"

namespace tweenfall::contacts {
struct ContactConstraint;
}

namespace tweenfall::blocks {

struct IslandBody;

/// The contacts of a block; null for an empty lane.
using ContactOrigin = std::array<contacts::ContactConstraint*, lane_count>;

/// What rows change in a body: its velocity; in another array, its displacement since the start of the step.
struct alignas(64) BodyLanes {
  double linear[4] = {};   ///< x, y, z and nothing
  double angular[4] = {};  ///< for a displacement: the sum of the turns, rad
};

/// From a body's velocity at the end of a sub-step to its mean, m/s.
struct alignas(32) BodyLag {
  double lanes[4] = {};  ///< x, y, z, and 1 if something presses on the body
};

/// One point of each pair along the normal.
struct PointRow {
  Lanes3 turn_a, turn_b;  ///< arm x normal
  Lanes mass;             ///< impulse per unit of speed, kg; 0 if a lane has no such point
  Lanes gap;              ///< at the start of the sub-step
  Lanes impulse;          ///< of the sub-step, N s
  Lanes lever;            ///< distance from the middle of the points, m
  Lanes base;             ///< gap before any displacement, m
  Lanes total;            ///< impulse of the step
  Lanes back = all(0);    ///< with which speed it springs back in this sub-step if it is pressed, m/s
};

/// Friction at one point, or for all points at their middle.
struct FrictionRow {
  Lanes3 first_a, first_b, second_a, second_b;  ///< arm x tangent
  Lanes inverse11, inverse12, inverse22;        ///< from the slip to the impulse that stops it
  Lanes firm;                                   ///< from the slip to an impulse that never overshoots
  Lanes first, second;                          ///< impulses of the sub-step, N s
  Lanes total_first, total_second;
};

/// Velocity of one surface against the other at a row of friction, in addition to the motion of the bodies.
struct DriftRow {
  Lanes first, second;              ///< of b against a along the tangents, m/s
  Lanes later_first, later_second;  ///< the same once the bodies have been moved
  Lanes twist;                      ///< about the normal, rad/s
};

/// For bodies with different moments about their axes.
struct InertiaRow {
  LanesSymmetric inverse_a, inverse_b;
};

/// Which rows a block has.
struct BlockMakeup {
  std::uint32_t point = 0, friction = 0;  ///< first rows
  std::uint32_t inertia = 0;              ///< its row, if `even` is false
  std::int8_t points = 0;                 ///< of the lane with the most; those that other lanes lack have no mass
  std::int8_t frictions = 0;              ///< none, one at the middle of several points, or one per point
  bool even = true;                       ///< all bodies have the same moment about every axis

  [[nodiscard]] bool central() const { return frictions == 1 && points > 1; }
};

struct ContactBlock : BlockMakeup {
  std::uint32_t a[lane_count], b[lane_count];            ///< places of the bodies in the solver
  std::uint32_t to_a[lane_count], to_b[lane_count];      ///< where their velocities go: for an immovable body, to
                                                         ///< a place that is never read
  bool drifts = false;                                   ///< some surface moves: there are rows for it
  bool springs = false;                                  ///< some point may spring back
  std::int8_t round_a[lane_count], round_b[lane_count];  ///< -1 for a ball: no contact can rock it
  Lanes3 normal, tangent1, tangent2;
  Lanes inverse_mass_a, inverse_mass_b;
  Lanes inverse_moment_a, inverse_moment_b;  ///< if `even`
  Lanes coefficient;                         ///< of friction
  Lanes twist_mass, twist, total_twist;      ///< about the normal, if friction is at the middle
  Mask hard;                                 ///< not soft: an impact
  Mask pressed, held;                        ///< by an impulse in this sub-step; by friction without sliding
};

/// Two balls, or one on an immovable body: an impulse along the line of centers turns nothing.
struct BallBlock {
  std::uint32_t a[lane_count], b[lane_count];
  std::uint32_t to_a[lane_count], to_b[lane_count];
  Lanes3 normal;
  Lanes inverse_mass_a, inverse_mass_b;
  Lanes arm_a, arm_b;     ///< from the centers to the contact, m
  Lanes spin_a, spin_b;   ///< arm times inverse moment
  Lanes mass, slip_mass;  ///< along the normal, and across it
  Lanes gap, impulse;     ///< as of a PointRow
  Lanes3 friction;        ///< impulse of the sub-step, N s
  Lanes coefficient;
  Mask hard, pressed;
  Lanes base, total;
  Lanes back = all(0);  ///< as of a PointRow
  Lanes3 total_friction;
};

/// When contacts meet: see Closing.
struct MeetingRow {
  Lanes pull, tremble;
  Lanes heeded;  ///< 1 if something follows when they meet: they spring back, or joints pass on their blow
};

/// How soft an overlapping contact is in one or more passes: the same in all lanes.
struct PassRule {
  Lanes rate = all(0);       ///< share of the overlap that is removed, 1/s
  Lanes speed = all(0);      ///< greatest speed, m/s
  Lanes firm = all(1);       ///< share of the speed error removed
  Lanes keeping = all(1);    ///< share of the impulse kept
  Lanes inverse_h = all(0);  ///< of the sub-step, 1/s
  Lanes enough = all(0);     ///< with several passes: a smaller change no longer matters, per speed from the impulses
  int passes = 1;            ///< more than one only if no two lanes share a movable body
  bool measures = false;     ///< first finds the gaps of the sub-step
  bool note = false;         ///< records what is pressed and held
  bool springs = false;      ///< what is pressed springs back
  bool sum_up = false;       ///< adds the impulses to the totals
};

/// Rows of a whole island, and its bodies. Immovable bodies have the last word: contacts of one movable body come after
/// those of two.
struct Rows {
  ContactBlock* blocks = nullptr;
  std::size_t pairs = 0, count = 0;  ///< blocks with two movable bodies in each lane, and all blocks
  BallBlock* balls = nullptr;
  std::size_t ball_pairs = 0, ball_count = 0;
  PointRow* points = nullptr;
  FrictionRow* frictions = nullptr;
  const DriftRow* drifts = nullptr;  ///< parallel to `frictions`; not read for blocks without any
  InertiaRow* inertias = nullptr;
  const ContactOrigin* origins = nullptr;  ///< of blocks
  const IslandBody* bodies = nullptr;
  const MeetingRow* meetings = nullptr;       ///< of blocks
  const MeetingRow* ball_meetings = nullptr;  ///< of balls
  BodyLanes* velocities = nullptr;
  const BodyLanes* displacements = nullptr;
  BodyLag* lags = nullptr;
};

/// A range of blocks, or of balls.
[[nodiscard]] inline Rows part_of(Rows rows, bool of_balls, std::size_t begin, std::size_t end) {
  rows.pairs = rows.count = of_balls ? 0 : end - begin;
  rows.ball_pairs = rows.ball_count = of_balls ? end - begin : 0;
  (of_balls ? rows.ball_meetings : rows.meetings) += begin;
  if (of_balls) {
    rows.balls += begin;
  } else {
    rows.blocks += begin;
    rows.origins += begin;
  }
  return rows;
}

/// Operations on rows, for one instruction set. All sets give the same bits.
struct Kernels {
  /// Finds directions, masses and friction of the blocks, where the bodies are at the start of the step.
  void (*prepare)(const Rows& rows);
  /// Again for bodies that have turned since. @param given  what the impulses of the sub-step before gave is in the
  /// velocities
  void (*prepare_again)(const Rows& rows, bool given);
  /// Applies the impulses of the sub-step before again.
  void (*warm_start)(const Rows& rows);
  /// Passes over each of the blocks: friction on the circular cone, then the normals.
  void (*solve)(const Rows& rows, const PassRule& rule);
  /// Removes from the lags of pressed bodies what a contact holds: the part along the normal, or all of it.
  void (*hold)(const Rows& rows);
  /// Finds the gaps, and what may meet in the sub-step fast enough to rebound: lanes as 8 * block + lane, in order;
  /// balls after all blocks. `starts`: velocities at the start of the sub-step; `found`: room for all lanes. Returns
  /// how many.
  std::size_t (*find_meetings)(const Rows& rows, const BodyLanes* starts, double h, std::uint32_t* found);
};

/// For all instruction sets that this processor has, the plainest first and the widest last.
[[nodiscard]] std::span<const Kernels* const> possible_kernels();
/// The last of them.
[[nodiscard]] const Kernels& fastest_kernels();

}  // namespace tweenfall::blocks
