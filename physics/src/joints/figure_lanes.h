#pragma once

/// Figures of one shape, one in each lane: bodies and joints of a ragdoll beside those of seven others.

#include <array>
#include <cstdint>
#include <span>

#include "islands/blocks/contact_block.h"
#include "state/joint.h"

namespace tweenfall::joints {

struct LanesQuat {
  blocks::Lanes w, x, y, z;
};

struct FigureBody {
  blocks::Lanes3 linear, angular;  ///< velocity; while places are brought together how far it goes
  blocks::Lanes inverse_mass;
  blocks::LanesSymmetric inverse_inertia;  ///< world axes
  bool moves = false;

  // For rows that are written in lanes
  blocks::Lanes3 center;
  LanesQuat rotation;
  blocks::Lanes3 spin;  ///< as far as its bend can be followed, rad/s
};

/// How the rows of a joint are written: one lane after the other, as its kind says; or in all lanes at once.
enum class Writing : std::uint8_t { by_kind, point, limb };

/// What rows are written from in lanes. Swing and twist are those of a `SwingTwistJoint`.
struct FigureFrame {
  blocks::Lanes3 pivot_a, pivot_b;  ///< from the centers of mass, node axes
  LanesQuat axes_a, axes_b;         ///< node axes
  blocks::Lanes swing_y, swing_z, twist_low, twist_high;
  blocks::Lanes side_y, side_z;                                   ///< see state::Joint
  std::array<blocks::Lanes, state::Joint::most_rows> impulses{};  ///< of the last sub-step, by row of the joint
};

/// A row that at least one lane has. What counts lanes is 1 or 0 in each.
struct FigureRow {
  blocks::Lanes3 linear_a, turn_a, linear_b, turn_b;  ///< see Direction
  blocks::Lanes wanted, wanted_after, left, compliance, low, high;
  blocks::Lanes impulse;
  blocks::Lanes reserve;  ///< added to its own inverse mass, as a part of it
  blocks::Lanes inverse;  ///< speed that the row alone gains by a unit of impulse
  blocks::Lanes present;  ///< the lane has this row
  blocks::Lanes bounded;  ///< it bounds or drives
  blocks::Lanes in;       ///< it is solved together with all others that are
};

/// A joint in each lane.
struct FigureJoint {
  static constexpr std::size_t most_rows = state::Joint::most_rows;

  std::uint32_t a = 0, b = 0;  ///< bodies of the figure
  Writing writing = Writing::by_kind;
  bool point = false;                             ///< its first three rows hold a point: they are known by the arms
  std::uint8_t count = 0;                         ///< rows of the lane with most
  std::uint8_t holds = 0;                         ///< the first ones, that are in in every lane
  std::array<bool, most_rows> turning{};          ///< rows that push nothing along
  std::array<std::uint8_t, most_rows> sources{};  ///< rows of the joint, where they are written in lanes
  blocks::Lanes3 arm_a, arm_b;
  blocks::Lanes3 push, turn;  ///< on b in the step so far, N s and N m s

  // For the rows that are in in some lane
  std::uint8_t in_count = 0;
  std::array<std::uint8_t, most_rows> slots{};
  std::uint32_t value = 0, diagonal = 0;  ///< first ones in their arrays
};

/// What a joint acts on that is eliminated later.
struct FigureLink {
  std::uint32_t place = 0;
  std::uint32_t block = 0;  ///< where its block begins
};

/// Eight figures at most.
struct Figures {
  int used = 0;  ///< lanes
  std::uint32_t body_count = 0, joint_count = 0;
  FigureBody* bodies = nullptr;
  FigureJoint* joints = nullptr;          ///< in the order of elimination
  FigureRow* rows = nullptr;              ///< most_rows for each joint
  FigureFrame* frames = nullptr;          ///< beside joints, if any is written in lanes
  const std::uint32_t* firsts = nullptr;  ///< of each joint into links, and their end
  FigureLink* links = nullptr;
  const std::uint32_t* places = nullptr;  ///< eight for each body
  blocks::BodyLanes* velocities = nullptr;
  blocks::Lanes* blocks = nullptr;  ///< of the factors, row by row; on diagonals the inverses, or 0 for what says
                                    ///< nothing new
  blocks::Lanes* values = nullptr;
  bool stale = true;    ///< the factors are of other rows
  bool silent = false;  ///< some row says nothing new
};

/// How rows are written: see JointRows::begin.
struct WriteRule {
  double h = 0, rate = 0, dt = 0;
  bool errors_only = false;
};

/// What is done with figures, for one instruction set. The bits do not depend on it.
struct FigureKernels {
  /// Writes the rows of the joints for which that is done in lanes.
  void (*write)(Figures& figures, const WriteRule& rule);
  /// Applies the impulses that the rows have.
  void (*warm_start)(Figures& figures);
  /// Solves for the speeds that the rows want, with what is in changing places with what is at its bound.
  void (*solve)(Figures& figures, bool moving);
  /// What pressed against a bound while errors were taken apart is there now.
  void (*moved)(Figures& figures);
  /// Finds how the bodies have to move for what is left of errors.
  /// @param of_what_holds  leaves out all that bounds
  /// @param live    lanes, 1 or 0; the others do not move
  /// @param widest  of the errors in each lane, m or rad
  void (*close)(Figures& figures, bool of_what_holds, const blocks::Lanes& live, blocks::Lanes& widest);
  /// Leaves out all that bounds or drives, and begins without impulses.
  void (*hold_only)(Figures& figures);
  /// Adds the impulses to the sums of the step.
  void (*add_up)(Figures& figures);
};

/// For all instruction sets that this processor has, the plainest first and the widest last.
[[nodiscard]] std::span<const FigureKernels* const> possible_figure_kernels();
/// The last of them.
[[nodiscard]] const FigureKernels& fastest_figure_kernels();

}  // namespace tweenfall::joints
