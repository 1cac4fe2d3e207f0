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

/// A point through a step. A unit of impulse along the normal, or across it, gives the spin `turn`, or
/// `slip`, times the body's inverse moment of inertia.
struct PointRow {
  Lanes turn_a, turn_b;  ///< arm x normal
  Lanes slip_a, slip_b;  ///< arm x tangent
  Lanes gap;             ///< at the start of the step, m
  Lanes mass, slip_mass;
  Lanes normal, sideways;              ///< impulses of the sub-step, N s
  Lanes total_normal, total_sideways;  ///< of the step
};

struct ContactBlock {
  std::uint32_t a[lane_count], b[lane_count];
  int points = 0;
  Lanes normal_x, normal_y;
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

/// Operations on all blocks, one after the other.
struct Kernels {
  void (*warm_start)(ContactBlock* blocks, std::size_t count, BodyRow* velocities);
  void (*solve)(ContactBlock* blocks, std::size_t count, BodyRow* velocities, const BodyRow* displacements,
                const PassRule& rule);
};

/// For the widest registers that this processor has. All give the same bits.
[[nodiscard]] const Kernels& kernels();
/// All that this processor can run, the plain ones first.
[[nodiscard]] std::span<const Kernels* const> possible_kernels();

}  // namespace tweenfall::planar::inner
