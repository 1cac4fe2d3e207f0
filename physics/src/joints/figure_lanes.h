#pragma once

/// Figures of one shape, one per lane: bodies and joints of a ragdoll beside those of seven others.

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
  blocks::Lanes3 linear, angular;  ///< velocity; while errors are closed, displacement
  blocks::Lanes inverse_mass;
  blocks::LanesSymmetric inverse_inertia;  ///< world axes
  bool moves = false;

  // For rows that are written in lanes
  blocks::Lanes3 center;
  LanesQuat rotation;
  blocks::Lanes3 spin;  ///< as far as the bend of its path can be followed, rad/s
};

/// How the rows of a joint are written: lane by lane, by the functions of its kind; or in all lanes at once.
enum class Writing : std::uint8_t { by_kind, point, limb };

/// The input for rows written in lanes. Swing and twist are those of a `SwingTwistJoint`.
struct FigureFrame {
  blocks::Lanes3 pivot_a, pivot_b;  ///< from the centers of mass, node axes
  LanesQuat axes_a, axes_b;         ///< node axes
  blocks::Lanes swing_y, swing_z, twist_low, twist_high;
  blocks::Lanes side_y, side_z;                                   ///< see state::Joint
  std::array<blocks::Lanes, state::Joint::most_rows> impulses{};  ///< of the last sub-step, by row of the joint
};

/// A row that at least one lane has. Flags of lanes are 1 or 0.
struct FigureRow {
  blocks::Lanes3 linear_a, turn_a, linear_b, turn_b;  ///< see Direction
  blocks::Lanes wanted, wanted_after, left, compliance, low, high;
  blocks::Lanes impulse;
  blocks::Lanes reserve;  ///< added to its own inverse mass, as a part of it
  blocks::Lanes inverse;  ///< speed that the row alone gains per unit of impulse
  blocks::Lanes present;  ///< the lane has this row
  blocks::Lanes bounded;  ///< it bounds or drives
  blocks::Lanes in;       ///< it is solved together with all others that are `in`
};

/// Lanes may be solved in so many parts: rows of each change places between `in` and beside by themselves.
constexpr std::size_t most_parts = 2;

/// The rows of a joint that are `in` in some lane of a part.
struct FigureRowsIn {
  std::uint8_t count = 0;
  bool changed = true;  ///< since the factors were found, in some lane
  bool stale = true;    ///< its factors are to be found anew: it changed, or a joint eliminated before it
  bool silent = false;  ///< some row is redundant
  std::array<std::uint8_t, state::Joint::most_rows> slots{};
  std::uint32_t value = 0, diagonal = 0;  ///< index of the first ones in their arrays
};

/// A joint in each lane.
struct FigureJoint {
  static constexpr std::size_t most_rows = state::Joint::most_rows;

  std::uint32_t a = 0, b = 0;  ///< bodies of the figure
  Writing writing = Writing::by_kind;
  bool point = false;                             ///< its first three rows hold a point: the arms give their directions
  std::uint8_t count = 0;                         ///< rows of the lane with the most
  std::uint8_t holds = 0;                         ///< the first rows, which are `in` in every lane
  std::array<bool, most_rows> turning{};          ///< rows without a linear part
  std::array<std::uint8_t, most_rows> sources{};  ///< rows of the joint, if they are written in lanes
  blocks::Lanes3 arm_a, arm_b;
  blocks::Lanes3 push, turn;                  ///< on b in the step so far, N s and N m s
  std::array<FigureRowsIn, most_parts> in{};  ///< by part
};

/// A joint that is affected and eliminated later.
struct FigureLink {
  std::uint32_t place = 0;
  std::array<std::uint32_t, most_parts> blocks{};  ///< start of its block, by part
};

/// The factors of a part.
struct FigurePart {
  bool stale = true;     ///< all of them belong to other rows
  bool changed = false;  ///< some joint's do
  bool silent = false;   ///< some row is redundant
};

/// Up to eight figures.
struct Figures {
  int used = 0;  ///< lanes
  std::uint32_t body_count = 0, joint_count = 0;
  FigureBody* bodies = nullptr;
  FigureJoint* joints = nullptr;          ///< in the order of elimination
  FigureRow* rows = nullptr;              ///< most_rows per joint
  FigureFrame* frames = nullptr;          ///< parallel to `joints`, if any is written in lanes
  const std::uint32_t* firsts = nullptr;  ///< index of each joint's first link, and the end
  FigureLink* links = nullptr;
  const std::uint32_t* places = nullptr;  ///< eight per body
  blocks::BodyLanes* velocities = nullptr;
  blocks::Lanes* blocks = nullptr;  ///< of the factors, row by row; the diagonal holds inverses, or 0 for a row that is
                                    ///< redundant
  blocks::Lanes* values = nullptr;
  std::array<FigurePart, most_parts> parts{};
};

/// How rows are written: see JointRows::begin.
struct WriteRule {
  double h = 0, rate = 0, dt = 0;
  bool errors_only = false;
};

/// Operations on figures, for one instruction set. All sets give the same bits.
struct FigureKernels {
  /// Writes the rows of the joints that are written in lanes.
  void (*write)(Figures& figures, const WriteRule& rule);
  /// Applies the impulses that the rows have.
  void (*warm_start)(Figures& figures);
  /// Solves for the speeds that the rows want; rows change places between `in` and their bounds.
  void (*solve)(Figures& figures, bool moving);
  /// Updates the rows that pressed against a bound while errors were corrected: they are at it now.
  void (*moved)(Figures& figures);
  /// Finds how the bodies have to move to remove the remaining errors.
  /// @param of_what_holds  leaves out all rows that bound
  /// @param live    lanes, 1 or 0; the others do not move
  /// @param widest  of the errors in each lane, m or rad
  void (*close)(Figures& figures, bool of_what_holds, const blocks::Lanes& live, blocks::Lanes& widest);
  /// Leaves out all rows that bound or drive, and starts without impulses.
  void (*hold_only)(Figures& figures);
  /// Adds the impulses to the sums of the step.
  void (*add_up)(Figures& figures);
};

/// For all instruction sets that this processor has, the plainest first and the widest last.
[[nodiscard]] std::span<const FigureKernels* const> possible_figure_kernels();
/// The last of them.
[[nodiscard]] const FigureKernels& fastest_figure_kernels();

}  // namespace tweenfall::joints
