#pragma once

/// A joint as rows: each holds one relative speed of its two bodies by one impulse.

#include <array>
#include <limits>

#include "joints/placement.h"

namespace tweenfall::joints {

/// What a row sees and moves: speed = linear_b . v_b + turn_b . w_b - linear_a . v_a - turn_a . w_a.
struct Direction {
  Vec3 linear_a{0, 0, 0}, turn_a{0, 0, 0}, linear_b{0, 0, 0}, turn_b{0, 0, 0};
};
[[nodiscard]] Direction operator-(const Direction& direction);

/// The bodies turn against each other about an axis.
[[nodiscard]] Direction about(const Vec3& axis);
/// b's frame moves along an axis that is fixed to a.
[[nodiscard]] Direction along(const Placement& at, const Vec3& axis);
/// The frames' origins move apart along a direction that is fixed to neither.
[[nodiscard]] Direction apart(const Placement& at, const Vec3& direction);

constexpr std::size_t most_rows = state::Joint::most_rows;
/// Parts of a row's inverse mass: what is left of one that says nothing new is rounding.
constexpr double new_enough = 1e-10;
/// What holds gives way by this part of its impulse, so that rows which contradict each other cannot throw bodies
/// about.
constexpr double give = 1e-8;
/// Rows with bounds may nearly say what others say already; with so much more of their own inverse mass they do not ask
/// for any impulse, and are met all the same when solved once more.
constexpr double caution = 0.003;

/// What starts far from where its joint wants it is drawn there no faster than so, m/s and rad/s: it may push others on
/// its way.
constexpr double fastest_approach = 4;
constexpr double fastest_turn = 10;
/// What has not passed its bound by more comes back at leisure, m or rad.
constexpr double far_beyond = 3e-3;
/// How far a blow may turn what stood still within a sub-step, rad: bounds that are nearer are minded.
constexpr double reach_of_blow = 0.1;

/// The bend of an arc tells nothing when a sub-step turns further, rad.
constexpr double followable = 0.3;

struct Row {
  Direction direction;
  double wanted = 0;         ///< speed while errors are taken apart
  double wanted_after = 0;   ///< and once the bodies have moved
  double left = 0;           ///< of its error when the step is over: how far it goes there, m or rad
  double compliance = 0;     ///< speed that a soft row lets go for a unit of impulse; 0 for a hard one
  double low = 0, high = 0;  ///< of the impulse, N s or N m s
};

/// Speeds between which the hard bounds of a coordinate let it be, while errors are taken apart and after.
struct Allowed {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  double low_after = low, high_after = high;
};

enum class Part : char {
  idle,    ///< does nothing, and is not written
  beside,  ///< its impulse stays where it is: at a bound
  in,      ///< solved together with all others that are
};

/// How the rows of a joint see its two bodies.
struct Masses {
  double inverse_mass_a = 0, inverse_mass_b = 0;
  Mat3 inverse_inertia_a = Mat3::Zero(), inverse_inertia_b = Mat3::Zero();  ///< world axes
};

/// Rows of one joint in a sub-step: first those that hold, then those with bounds.
class JointRows {
 public:
  /// @param h     length of the sub-step, s
  /// @param rate  share of an error that is taken apart, 1/s
  /// @param dt    length of the step, s
  /// @param turn  how far the bodies turn against each other in the sub-step as they move, rad
  void begin(const Masses& masses, double h, double rate, double dt, double turn);
  /// For errors alone: leaves out what drives, and bounds that are not passed.
  void errors_only();

  // What holds; all of them before any that bounds
  /// @param bend  how the error accelerates when both bodies go on as they move
  void hold(const Direction& direction, double error, double bend);
  /// The way that b's frame has gone along an axis that is fixed to a.
  void hold_across(const Placement& at, const Vec3& axis);
  /// An axis of a stays perpendicular to one of b.
  void hold_square(const Placement& at, const Vec3& axis_a, const Vec3& axis_b);
  void hold_point(const Placement& at);     ///< three rows
  void hold_rotation(const Placement& at);  ///< three rows

  // What bounds or drives; the same number of rows whether they act or not
  /// Two rows.
  /// @param bend  how the position accelerates when both bodies go on as they move
  Allowed bound(const Direction& direction, double position, const Limits* limits, double bend = 0);
  /// One row. A speed that bounds do not allow is not asked for: what pushes against each other without end is too much
  /// for the rounds in which rows change places.
  void drive(const Direction& direction, double position, const Motor* motor, const Allowed& allowed = {});
  void draw(const Direction& direction, double error, double speed, double hz, double zeta, double most);
  void spring(const Direction& direction, double error, double stiffness, double damping);
  void idle(std::size_t rows = 1);
  /// How a length accelerates in the sub-step when its ends go on as they move.
  /// @param side  along it, of length 1
  /// @param rate  of its ends against each other, m/s
  /// @param bend  their acceleration against each other, m/s^2
  [[nodiscard]] double bend_of(double length, const Vec3& side, const Vec3& rate, const Vec3& bend) const;
  /// An angle farther than this from a bound is not concerned with it, rad.
  [[nodiscard]] double far() const { return far_; }

  /// Lets the impulse of a coming row begin with a share of what it was.
  void keep_of_next(std::size_t ahead, double share) { impulses[count + ahead] *= share; }

  std::array<double, most_rows> impulses{};  ///< of the sub-step, N s or N m s
  std::array<Part, most_rows> parts{};
  std::array<Row, most_rows> rows;  ///< those that are idle hold nothing
  std::size_t together = 0, count = 0;
  bool point = false;  ///< the first three hold a point: their directions are known by the arms, and not written

 private:
  Row& add();
  Row& add(const Direction& direction);
  /// Says whether the row that was added last takes part, by the impulse that it has.
  void place_last();
  [[nodiscard]] double coupling(const Direction& first, const Direction& second) const;
  /// What the last row added moves while the joint holds: speed by a unit of impulse; 0 for nothing.
  [[nodiscard]] double held_inverse_mass() const;

  void draw_near(Row& row, double error, bool angular);
  [[nodiscard]] Direction direction_of(std::size_t row) const;

  Masses masses_;
  Vec3 arm_a_{0, 0, 0}, arm_b_{0, 0, 0};  ///< of the point
  double h_ = 0, rate_ = 0, dt_ = 0, far_ = 0;
  bool errors_only_ = false;
};

}  // namespace tweenfall::joints
