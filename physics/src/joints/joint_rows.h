#pragma once

/// A joint as rows: each controls one relative speed of its two bodies by one impulse.

#include <array>
#include <limits>

#include "joints/placement.h"

namespace tweenfall::joints {

/// The speed that a row sees, and moves: linear_b . v_b + turn_b . w_b - linear_a . v_a - turn_a . w_a.
struct Direction {
  Vec3 linear_a{0, 0, 0}, turn_a{0, 0, 0}, linear_b{0, 0, 0}, turn_b{0, 0, 0};
};
[[nodiscard]] Direction operator-(const Direction& direction);

/// The bodies turn relative to each other about an axis.
[[nodiscard]] Direction about(const Vec3& axis);
/// b's frame moves along an axis that is fixed to a.
[[nodiscard]] Direction along(const Placement& at, const Vec3& axis);
/// The frames' origins move apart along a direction that is fixed to neither.
[[nodiscard]] Direction apart(const Placement& at, const Vec3& direction);

constexpr std::size_t most_rows = state::Joint::most_rows;
/// A row with less than this part of its inverse mass left is redundant: the rest is rounding.
constexpr double new_enough = 1e-10;
/// Rows that hold yield by this part of their impulse, so that contradictory rows cannot throw bodies
/// about.
constexpr double give = 1e-8;
/// Rows with bounds may be nearly redundant; with this part of their own inverse mass added, they do not ask
/// for a huge impulse, and solving once more satisfies them all the same.
constexpr double caution = 0.003;

/// A body that starts far from where its joint wants it is pulled there no faster than this, m/s and rad/s, since it
/// may push others on its way.
constexpr double fastest_approach = 4;
constexpr double fastest_turn = 10;
/// A bound that is passed by no more than this is corrected slowly, m or rad.
constexpr double far_beyond = 3e-3;
/// How far a blow may turn a body at rest within a sub-step, rad: bounds that are nearer get rows.
constexpr double reach_of_blow = 0.1;

/// If a sub-step turns further than this, the bend of an arc says nothing, rad.
constexpr double followable = 0.3;

struct Row {
  Direction direction;
  double wanted = 0;         ///< speed while errors are corrected
  double wanted_after = 0;   ///< speed once the bodies have moved
  double left = 0;           ///< remaining error at the end of the step, which is removed then, m or rad
  double compliance = 0;     ///< speed that a soft row yields per unit of impulse; 0 for a hard one
  double low = 0, high = 0;  ///< of the impulse, N s or N m s
};

/// Speeds that the hard bounds of a coordinate allow, while errors are corrected and afterwards.
struct Allowed {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  double low_after = low, high_after = high;
};

enum class Part : char {
  idle,    ///< does nothing, and is not written
  beside,  ///< its impulse stays as it is: at a bound
  in,      ///< solved together with all others that are `in`
};

/// Masses of the two bodies of a joint.
struct Masses {
  double inverse_mass_a = 0, inverse_mass_b = 0;
  Mat3 inverse_inertia_a = Mat3::Zero(), inverse_inertia_b = Mat3::Zero();  ///< world axes
};

/// Rows of one joint in a sub-step: first those that hold, then those with bounds.
class JointRows {
 public:
  /// @param h     length of the sub-step, s
  /// @param rate  share of an error that is corrected, 1/s
  /// @param dt    length of the step, s
  void begin(const Masses& masses, const Placement& at, double h, double rate, double dt);
  /// For errors only: leaves out rows that drive, and bounds that are not passed.
  void errors_only();

  // Rows that hold; all of them come before those that bound
  /// @param bend  acceleration of the error if both bodies keep their velocities
  void hold(const Direction& direction, double error, double bend);
  /// Holds the displacement of b's frame along an axis that is fixed to a.
  void hold_across(const Placement& at, const Vec3& axis);
  /// Keeps an axis of a perpendicular to one of b.
  void hold_square(const Placement& at, const Vec3& axis_a, const Vec3& axis_b);
  void hold_point(const Placement& at);     ///< three rows
  void hold_rotation(const Placement& at);  ///< three rows

  // Rows that bound or drive; always the same number, whether they act or not
  /// Two rows.
  /// @param bend  acceleration of the position if both bodies keep their velocities
  Allowed bound(const Direction& direction, double position, const Limits* limits, double bend = 0);
  /// One row. It never asks for a speed that bounds do not allow: rows that push against each other without end would
  /// need too many rounds of changing places.
  void drive(const Direction& direction, double position, const Motor* motor, const Allowed& allowed = {});
  /// @param swings  whether a spring damped less than critically keeps its swing
  void draw(const Direction& direction, double error, double speed, double hz, double zeta, double most,
            bool swings = true);
  /// @param rate  of the error, with which the sub-step begins
  void spring(const Direction& direction, const Placement& at, double error, double rate, double stiffness,
              double damping);
  void idle(std::size_t rows = 1);
  /// Acceleration of a length in the sub-step if its ends keep their velocities.
  /// @param side  along it, of length 1
  /// @param rate  relative velocity of its ends, m/s
  /// @param bend  relative acceleration of its ends, m/s^2
  [[nodiscard]] double bend_of(double length, const Vec3& side, const Vec3& rate, const Vec3& bend) const;
  /// An angle farther than this from a bound needs no row for it, rad.
  [[nodiscard]] double far() const { return far_; }

  /// Scales the kept impulse of a coming row.
  void keep_of_next(std::size_t ahead, double share) { impulses[count + ahead] *= share; }

  std::array<double, most_rows> impulses{};  ///< of the sub-step, N s or N m s
  std::array<Part, most_rows> parts{};
  std::array<Row, most_rows> rows;  ///< idle ones hold nothing
  std::size_t together = 0, count = 0;
  bool point = false;  ///< the first three hold a point: the arms give their directions, which are not written

 private:
  Row& add();
  Row& add(const Direction& direction);
  /// Decides whether the row added last takes part, by the impulse that it has.
  void place_last();
  [[nodiscard]] double coupling(const Direction& first, const Direction& second) const;
  /// The inverse mass of the last row while the joint holds, 1/kg or the like; 0 if it moves nothing.
  [[nodiscard]] double held_inverse_mass() const;

  void draw_near(Row& row, double error, bool angular);
  /// @param advance  square of the angle by which it swings in the sub-step, rad^2
  void pull(Row& row, double error, double rate, double stiffness, double damping, double advance) const;
  [[nodiscard]] double rate_of(const Direction& direction) const;
  [[nodiscard]] Direction direction_of(std::size_t row) const;

  Masses masses_;
  Twist twist_a_, twist_b_;
  Vec3 arm_a_{0, 0, 0}, arm_b_{0, 0, 0};  ///< of the point
  double h_ = 0, rate_ = 0, dt_ = 0, far_ = 0;
  bool errors_only_ = false;
};

}  // namespace tweenfall::joints
