#include "joints/joint_rows.h"

#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tweenfall::joints {

Direction operator-(const Direction& direction) {
  return {-direction.linear_a, -direction.turn_a, -direction.linear_b, -direction.turn_b};
}

Direction about(const Vec3& axis) {
  return {Vec3::Zero(), axis, Vec3::Zero(), axis};
}

Direction along(const Placement& at, const Vec3& axis) {
  return {axis, (at.arm_a + at.gap()).cross(axis), axis, at.arm_b.cross(axis)};
}

Direction apart(const Placement& at, const Vec3& direction) {
  return {direction, at.arm_a.cross(direction), direction, at.arm_b.cross(direction)};
}

void JointRows::begin(const Masses& masses, const Placement& at, double h, double rate, double dt) {
  masses_ = masses;
  twist_a_ = at.twist_a;
  twist_b_ = at.twist_b;
  h_ = h;
  rate_ = rate;
  dt_ = dt;
  far_ = reach_of_blow + 2 * h * (at.twist_b.angular - at.twist_a.angular).norm();
  together = count = 0;
  point = errors_only_ = false;
}

void JointRows::errors_only() {
  far_ = 0;
  errors_only_ = true;
}

Row& JointRows::add() {
  Row& row = rows[count++];
  row.compliance = row.left = 0;
  row.low = -std::numeric_limits<double>::infinity();
  row.high = std::numeric_limits<double>::infinity();
  parts[count - 1] = Part::in;
  return row;
}

Row& JointRows::add(const Direction& direction) {
  Row& row = add();
  row.direction = direction;
  return row;
}

void JointRows::place_last() {
  const Row& row = rows[count - 1];
  double& impulse = impulses[count - 1];
  impulse = std::clamp(impulse, row.low, row.high);
  parts[count - 1] = row.low < impulse && impulse < row.high ? Part::in : Part::beside;
}

void JointRows::idle(std::size_t many) {
  for (; many > 0; --many, ++count) {
    parts[count] = Part::idle;
    impulses[count] = 0;
  }
}

/// Moves toward where the error is 0.
void JointRows::draw_near(Row& row, double error, bool angular) {
  const double fastest = angular ? fastest_turn : fastest_approach;
  row.wanted += std::clamp(-rate_ * error, -fastest, fastest);
  row.left = std::clamp(-error, -fastest * dt_, fastest * dt_);
}

/// A body that moves straight for a sub-step leaves its arc: half of the bend brings it back onto the arc, and the
/// other half is what the next sub-step starts with, so that no energy is lost on the way around. Source: Andersen,
/// Rattle, Journal of Computational Physics 52, 1983.
void JointRows::hold(const Direction& direction, double error, double bend) {
  Row& row = add(direction);
  row.wanted = row.wanted_after = -0.5 * h_ * bend;
  draw_near(row, error, direction.linear_b == Vec3::Zero());
  ++together;
}

void JointRows::hold_across(const Placement& at, const Vec3& axis) {
  hold(along(at, axis), axis.dot(at.gap()), at.bend_along(axis));
}

void JointRows::hold_square(const Placement& at, const Vec3& axis_a, const Vec3& axis_b) {
  const Vec3& spin_a = at.twist_a.angular;
  const Vec3& spin_b = at.twist_b.angular;
  const double bend = Placement::bend(at.twist_a, axis_a).dot(axis_b) +
                      2 * spin_a.cross(axis_a).dot(spin_b.cross(axis_b)) +
                      axis_a.dot(Placement::bend(at.twist_b, axis_b));
  hold(about(axis_b.cross(axis_a)), axis_a.dot(axis_b), bend);
}

void JointRows::hold_point(const Placement& at) {
  point = count == 0;
  const Vec3 gap = at.gap();
  const Vec3 bend = at.gap_bend();
  if (!point) {
    for (int i = 0; i < 3; ++i) hold(apart(at, Vec3::Unit(i)), gap[i], bend[i]);
    return;
  }
  arm_a_ = at.arm_a;
  arm_b_ = at.arm_b;
  for (int i = 0; i < 3; ++i) {
    Row& row = add();
    row.wanted = row.wanted_after = -0.5 * h_ * bend[i];
    draw_near(row, gap[i], false);
  }
  together = count;
}

void JointRows::hold_rotation(const Placement& at) {
  const Vec3 off = log_map(at.axes_b * at.axes_a.conjugate());
  for (int i = 0; i < 3; ++i) hold(about(Vec3::Unit(i)), off[i], 0);
}

Allowed JointRows::bound(const Direction& direction, double position, const Limits* limits, double bend) {
  Allowed allowed;
  for (const bool low : {true, false}) {
    const double gap = !limits ? 0 : low ? position - limits->low : limits->high - position;
    if (!limits || std::isinf(gap)) {
      idle();
      continue;
    }
    const bool angular = direction.linear_b == Vec3::Zero();
    const bool soft = limits->hz > 0;
    if ((angular && gap > far_) || (soft && gap > 0)) {
      idle();
      continue;
    }
    if (soft) {
      // It acts from the start of the sub-step after it is passed on: what that adds, a backward Euler step takes.
      draw(low ? direction : -direction, gap, 0, limits->hz, limits->zeta, std::numeric_limits<double>::infinity(),
           false);
      if (parts[count - 1] == Part::idle) continue;
    } else {
      Row& row = add(low ? direction : -direction);
      // A taut row goes around like a row that holds: the small gap that an arc leaves is removed in the
      // sub-step, and no speed remains from it.
      const double around = -0.5 * h_ * (low ? bend : -bend);
      row.wanted = around + (gap > 0 ? -gap / h_ : 0);
      row.wanted_after = gap > h_ * std::abs(around) ? row.wanted : around;
      if (gap < 0) draw_near(row, gap, angular);
      if (gap > -far_beyond) row.left = 0;
      (low ? allowed.low : allowed.high) = low ? row.wanted : -row.wanted;
      (low ? allowed.low_after : allowed.high_after) = low ? row.wanted_after : -row.wanted_after;
    }
    rows[count - 1].low = 0;
    place_last();
  }
  return allowed;
}

void JointRows::drive(const Direction& direction, double position, const Motor* motor, const Allowed& allowed) {
  if (!motor || errors_only_) {
    idle();
  } else if (motor->position) {
    draw(direction, position - *motor->position, motor->speed, motor->hz, motor->zeta, motor->max_force);
  } else {
    Row& row = add(direction);
    row.wanted = std::max(allowed.low, std::min(motor->speed, allowed.high));
    row.wanted_after = std::max(allowed.low_after, std::min(motor->speed, allowed.high_after));
    row.high = motor->max_force * h_;
    row.low = -row.high;
    place_last();
  }
}

/// Newmark's method with the mean of accelerations (beta = 1/4, a quarter of the pull each before and after the
/// sub-step) neither adds energy nor takes any, however many springs pull at a body. The faster a spring swings for the
/// sub-step, the more of it is a backward Euler step, which damps the swing away. Source: Newmark, A Method of
/// Computation for Structural Dynamics, Journal of the Engineering Mechanics Division 85, 1959.
void JointRows::pull(Row& row, double error, double rate, double stiffness, double damping, double advance) const {
  // Square of the angle by which a swing may advance in a sub-step and be kept, rad^2.
  constexpr double followed = 0.1;
  const double kept = advance <= followed ? 1 : followed / advance;
  const double before = 0.25 * kept, after = 1 - 3 * before;
  const double firmness = damping + after * h_ * stiffness;
  row.compliance = 1 / (h_ * firmness);
  row.wanted = row.wanted_after = stiffness / firmness * (before * h_ * rate - error);
}

void JointRows::draw(const Direction& direction, double error, double speed, double hz, double zeta, double most,
                     bool swings) {
  if (errors_only_) return idle();
  Row& row = add(direction);
  const double turn = 2 * std::numbers::pi * hz * h_;
  const double pull_of_turn = turn * (2 * zeta + turn);
  const double inverse_mass = held_inverse_mass();
  if (!(pull_of_turn > 0 && inverse_mass > 0)) {
    --count;
    return idle();
  }
  if (swings && zeta < 1) {
    // The rate is that of before the points of its joint led a body on a lever back onto its arc: what that adds, up to
    // half of this share takes.
    constexpr double least_damping = 0.004;
    const double frequency = turn / h_, damped = std::max(zeta, least_damping * turn * turn);
    pull(row, error, rate_of(direction) - speed, frequency * frequency / inverse_mass,
         2 * damped * frequency / inverse_mass, turn * turn);
    row.wanted += speed;
    row.wanted_after += speed;
  } else {
    // Source: Catto, Soft Constraints, GDC 2011: an implicit spring on the mass that the row moves.
    row.compliance = inverse_mass / pull_of_turn;
    row.wanted = row.wanted_after = speed - turn / (h_ * (2 * zeta + turn)) * error;
  }
  row.high = most * h_;
  row.low = -row.high;
  place_last();
}

void JointRows::spring(const Direction& direction, const Placement& at, double error, double rate, double stiffness,
                       double damping) {
  if (!(h_ * (damping + h_ * stiffness) > 0) || errors_only_) return idle();
  Row& row = add(direction);
  // Its pull also swings the bodies across its line, and turns them about their levers.
  const double length = at.gap().norm();
  const auto turns = [&](const Mat3& inverse_inertia, const Vec3& lever) {
    const double turn = inverse_inertia.trace() * lever.norm();
    return turn > 0 ? turn * (1 + lever.norm() / length) : 0;
  };
  const double across = (masses_.inverse_mass_a + masses_.inverse_mass_b) / length +
                        turns(masses_.inverse_inertia_a, at.arm_a) + turns(masses_.inverse_inertia_b, at.arm_b);
  pull(row, error, rate, stiffness, damping,
       h_ * h_ * stiffness * (coupling(direction, direction) + (error == 0 ? 0 : std::abs(error) * across)));
}

double JointRows::rate_of(const Direction& direction) const {
  return direction.linear_b.dot(twist_b_.linear) + direction.turn_b.dot(twist_b_.angular) -
         direction.linear_a.dot(twist_a_.linear) - direction.turn_a.dot(twist_a_.angular);
}

double JointRows::bend_of(double length, const Vec3& side, const Vec3& rate, const Vec3& bend) const {
  // A body that passes close by goes around for only a part of the sub-step: use the length then, by Pythagoras.
  const double along = std::max(0.0, length + h_ * side.dot(rate));
  const double across = rate.cross(side).squaredNorm();
  const double lengths = along + std::sqrt(along * along + h_ * h_ * across);
  return side.dot(bend) + (lengths > 0 ? 2 * across / lengths : 0);
}

double JointRows::coupling(const Direction& first, const Direction& second) const {
  return masses_.inverse_mass_a * first.linear_a.dot(second.linear_a) +
         first.turn_a.dot(masses_.inverse_inertia_a * second.turn_a) +
         masses_.inverse_mass_b * first.linear_b.dot(second.linear_b) +
         first.turn_b.dot(masses_.inverse_inertia_b * second.turn_b);
}

Direction JointRows::direction_of(std::size_t row) const {
  if (!point || row >= 3) return rows[row].direction;
  const Vec3 axis = Vec3::Unit(static_cast<Vec3::Index>(row));
  return {axis, arm_a_.cross(axis), axis, arm_b_.cross(axis)};
}

double JointRows::held_inverse_mass() const {
  const Direction row = direction_of(count - 1);
  const double whole = coupling(row, row);
  std::array<Direction, most_rows> held;
  for (std::size_t i = 0; i < together; ++i) held[i] = direction_of(i);
  std::array<std::array<double, most_rows>, most_rows> factor{};
  std::array<double, most_rows> along{};
  double left = whole;
  for (std::size_t i = 0; i < together; ++i) {
    double sum = coupling(held[i], row);
    for (std::size_t k = 0; k <= i; ++k) {
      double entry = coupling(held[i], held[k]);
      const double own = entry;
      for (std::size_t n = 0; n < k; ++n) entry -= factor[i][n] * factor[k][n];
      if (k < i) {
        factor[i][k] = factor[k][k] > 0 ? entry / factor[k][k] : 0;
        sum -= factor[i][k] * along[k];
      } else {
        factor[i][i] = entry > new_enough * own ? std::sqrt(entry) : 0;
      }
    }
    along[i] = factor[i][i] > 0 ? sum / factor[i][i] : 0;
    left -= along[i] * along[i];
  }
  return left > new_enough * whole ? left : 0;
}

}  // namespace tweenfall::joints
