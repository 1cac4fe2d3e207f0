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

constexpr std::size_t most_together = 6;
/// Parts of a row's inverse mass: what is left of one that says nothing new is rounding.
constexpr double new_enough = 1e-10;
/// What holds gives way by this part of its impulse, so that rows which contradict each other cannot throw bodies
/// about.
constexpr double give = 1e-8;

struct Row {
  Direction direction;
  Vec3 spin_a{0, 0, 0}, spin_b{0, 0, 0};  ///< angular velocity by a unit of impulse
  double mass = 0;                        ///< what a unit of speed takes, kg or kg m^2; 0: the row is idle
  double wanted = 0;                      ///< speed while errors are taken apart
  double wanted_after = 0;                ///< and once the bodies have moved
  double firm = 1;                        ///< share of the speed error met
  double giving = 0;                      ///< share of the impulse let go
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();  ///< N s
  /// By a unit of impulse along a row with bounds: what those that hold have to give along, so that it does not pull
  /// the joint apart.
  std::array<double, most_together> along{};
  double impulse = 0;  ///< of the sub-step, N s or N m s
};

/// How the rows of a joint see its two bodies.
struct Masses {
  double inverse_mass_a = 0, inverse_mass_b = 0;
  Mat3 inverse_inertia_a = Mat3::Zero(), inverse_inertia_b = Mat3::Zero();  ///< world axes
};

/// Rows of one joint in a sub-step: first those that are solved together, exactly, then one by one those with bounds.
class JointRows {
 public:
  /// @param h     length of the sub-step, s
  /// @param rate  share of an error that is taken apart, 1/s
  void begin(const Masses& masses, double h, double rate);

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
  void bound(const Direction& direction, double position, const Limits* limits);  ///< two rows
  void drive(const Direction& direction, double position, const Motor* motor);    ///< one row
  void draw(const Direction& direction, double error, double speed, double hz, double zeta, double most);
  void spring(const Direction& direction, double error, double stiffness, double damping);
  void idle(std::size_t rows = 1);

  /// Lets the impulse of a coming row begin with a share of what it was.
  void keep_of_next(std::size_t ahead, double share) { rows[count + ahead].impulse *= share; }

  /// Once all are written: lets the rows with bounds see the mass that they move while the joint holds.
  void finish();

  std::array<Row, state::Joint::most_rows> rows;
  std::size_t together = 0, count = 0;

 private:
  Row& add(const Direction& direction);
  [[nodiscard]] double coupling(const Row& first, const Row& second) const;

  Masses masses_;
  double h_ = 0, rate_ = 0;
};

}  // namespace tweenfall::joints
