#pragma once

/// Contacts in a plane side by side, for the solver: within a block, none shares a movable body.

#include <cstddef>
#include <cstdint>
#include <span>

#include "islands/blocks/lanes.h"

namespace tweenfall::planar::inner {

using blocks::Lanes;
constexpr int lane_count = blocks::lane_count;

/// A body's velocity or displacement; the third number is about the center of mass.
struct alignas(32) BodyRow {
  double x = 0, y = 0, turn = 0, unused = 0;
};

/// How many numbers a row has.
constexpr std::uint32_t row_length = sizeof(BodyRow) / sizeof(double);

/// A point through a step. A unit of impulse along the normal, or across it, gives the spin `turn`, or
/// `slip`, times the body's inverse moment of inertia. Until it is prepared, `turn_a`, `turn_b` and `slip_a`, `slip_b`
/// are the places on the cores of a and b, each in its own axes, and the mass is 1, or 0 where there is no such point.
struct PointRow {
  Lanes turn_a, turn_b;  ///< arm x normal
  Lanes slip_a, slip_b;  ///< arm x tangent
  Lanes gap;             ///< at the start of the step, m
  Lanes mass, slip_mass;
  Lanes normal, sideways;              ///< impulses of the sub-step, N s
  Lanes total_normal, total_sideways;  ///< of the step
};

struct ContactBlock {
  std::uint32_t a[lane_count], b[lane_count];  ///< where the rows of the bodies begin: `row_length` times their indices
  int points = 0;
  Lanes normal_x, normal_y;  ///< until it is prepared, in a's axes
  Lanes skin_a, skin_b;      ///< m
  Lanes approach;            ///< greatest closing speed of a point at the start of the step, m/s; at least 0
  Lanes friction;
  Lanes ahead;  ///< share of a gap that may be closed per second while nothing presses: rebounds are not held
  Lanes inverse_mass_a, inverse_mass_b, inverse_moment_a, inverse_moment_b;
  PointRow point[2];
};

/// How a pass treats overlap.
struct PassRule {
  double rate = 0;       ///< share of the overlap that is removed, 1/s
  double speed = 0;      ///< greatest speed, m/s
  double firm = 1;       ///< share of the speed error that is removed
  double keep = 1;       ///< share of the impulse that is kept
  double inverse_h = 0;  ///< 1/s
  bool sum_up = false;   ///< afterwards, impulses are added to those of the step
};

/// Bodies through a sub-step, by body. Unless told otherwise, what is written is that of the bodies that move.
struct BodyRows {
  BodyRow* velocities = nullptr;
  BodyRow* starts = nullptr;         ///< velocities at the start of the sub-step
  BodyRow* unpushed = nullptr;       ///< velocities that it would have ended with without contacts
  BodyRow* displacements = nullptr;  ///< since the start of the step
  const BodyRow* gains = nullptr;    ///< of the velocities in a second, without contacts
};

/// Bodies at the start of a step, by body.
struct BodyStarts {
  const BodyRow* velocities = nullptr;
  const BodyRow* poses = nullptr;   ///< center, cosine and sine of the angle
  const BodyRow* masses = nullptr;  ///< inverse mass and moment of inertia
};

/// Operations on all blocks, one after the other, and on all bodies.
struct Kernels {
  void (*prepare)(ContactBlock* blocks, std::size_t count, const BodyStarts& bodies);
  void (*warm_start)(ContactBlock* blocks, std::size_t count, BodyRow* velocities);
  void (*solve)(ContactBlock* blocks, std::size_t count, BodyRow* velocities, const BodyRow* displacements,
                const PassRule& rule);
  /// Begins a sub-step of h seconds.
  /// @param again  contacts give at once what they gave in the sub-step before
  void (*begin)(const BodyRows& rows, std::span<const std::uint32_t> moving, double h, bool again);
  /// Moves bodies by what the passes left. A body that was not pushed flies by the mean of its velocities, exactly.
  void (*move)(const BodyRows& rows, std::span<const std::uint32_t> moving, double h);
  /// `move`, and `begin` again.
  void (*move_on)(const BodyRows& rows, std::span<const std::uint32_t> moving, double h);
};

/// For the widest registers that this processor has. All give the same bits.
[[nodiscard]] const Kernels& kernels();
/// All that this processor can run, the plain ones first.
[[nodiscard]] std::span<const Kernels* const> possible_kernels();

}  // namespace tweenfall::planar::inner
