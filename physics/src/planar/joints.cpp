#include "planar/joints.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tweenfall::planar::inner {

namespace {

// How fast joint errors are corrected: frequency times the sub-step, and damping ratio.
constexpr double joint_cycles = 0.25;
constexpr double joint_damping = 2;

/// An inverse mass of which no more than this part is left is rounding.
constexpr double new_enough = 1e-10;

}  // namespace

JointRows::JointRows(const std::vector<Body>& bodies, const std::vector<Makeup>& makeups, std::vector<Joint>& joints,
                     double h, double warmth, double parts)
    : h_(h) {
  const double turn = 2 * std::numbers::pi * joint_cycles / parts, stiffness = turn * (2 * joint_damping + turn);
  rate_ = turn / (h * (2 * joint_damping + turn));
  firm_ = stiffness / (1 + stiffness);
  giving_ = 1 / (1 + stiffness);
  const auto nobody = static_cast<std::uint32_t>(bodies.size());
  for (Joint& joint : joints) {
    if (!joint.alive) continue;
    Row row;
    row.joint = &joint;
    const auto end = [&](const BodyId& id, const Vec2& anchor, std::uint32_t& index, double& inverse_mass,
                         double& inverse_moment, Vec2& center, double& angle, Vec2& local) {
      index = nobody;
      center = anchor;
      if (id == BodyId{}) return false;
      index = id.index;
      const Body& body = bodies[index];
      inverse_mass = body.inverse_mass;
      inverse_moment = body.inverse_moment;
      center = body.center;
      angle = body.angle;
      local = anchor - makeups[index].mass.center;
      return body.under_way;
    };
    const JointSettings& its = joint.settings;
    const bool a_moves = end(its.a, its.anchor_a, row.a, row.inverse_mass_a, row.inverse_moment_a, row.center_a,
                             row.angle_a, row.local_a);
    const bool b_moves = end(its.b, its.anchor_b, row.b, row.inverse_mass_b, row.inverse_moment_b, row.center_b,
                             row.angle_b, row.local_b);
    const bool held_in_vain = row.inverse_mass_a + row.inverse_mass_b == 0;
    // A sleeping joint keeps its load.
    if (!(a_moves || b_moves) && !held_in_vain) continue;
    joint.total = Vec2(0, 0);
    joint.total_turn = 0;
    if (held_in_vain) continue;
    row.held_before = joint.held;
    row.motor_before = joint.motor;
    row.spring_before = joint.spring;
    row.lower_before = joint.lower;
    row.upper_before = joint.upper;
    for (double& one : joint.held) one *= warmth;
    for (double* one : {&joint.motor, &joint.lower, &joint.upper, &joint.spring}) *one *= warmth;
    rows_.push_back(row);
  }
}

double JointRows::coupling(const Row& row, const Line& one, const Line& other) {
  return row.inverse_mass_a * one.along_a.dot(other.along_a) + row.inverse_mass_b * one.along_b.dot(other.along_b) +
         row.inverse_moment_a * one.turn_a * other.turn_a + row.inverse_moment_b * one.turn_b * other.turn_b;
}

double JointRows::speed_of(const Row& row, const Line& line, const std::vector<BodyRow>& velocities) {
  const BodyRow &a = velocities[row.a], &b = velocities[row.b];
  return (line.along_b.x() * b.x - line.along_a.x() * a.x) + (line.along_b.y() * b.y - line.along_a.y() * a.y) +
         line.turn_b * b.turn - line.turn_a * a.turn;
}

void JointRows::push(const Row& row, const Line& line, double impulse, std::vector<BodyRow>& velocities) {
  BodyRow &a = velocities[row.a], &b = velocities[row.b];
  a.x -= row.inverse_mass_a * impulse * line.along_a.x();
  a.y -= row.inverse_mass_a * impulse * line.along_a.y();
  a.turn -= row.inverse_moment_a * impulse * line.turn_a;
  b.x += row.inverse_mass_b * impulse * line.along_b.x();
  b.y += row.inverse_mass_b * impulse * line.along_b.y();
  b.turn += row.inverse_moment_b * impulse * line.turn_b;
}

void JointRows::place(Row& row, const std::vector<BodyRow>& displacements) const {
  const JointSettings& its = row.joint->settings;
  const BodyRow &moved_a = displacements[row.a], &moved_b = displacements[row.b];
  row.turned_a = row.angle_a + moved_a.turn;
  row.arm_a = its.a == BodyId{} ? Vec2(0, 0) : Turn::of(row.turned_a) * row.local_a;
  row.arm_b = its.b == BodyId{} ? Vec2(0, 0) : Turn::of(row.angle_b + moved_b.turn) * row.local_b;
  row.apart =
      (row.center_b - row.center_a) + Vec2(moved_b.x - moved_a.x, moved_b.y - moved_a.y) + (row.arm_b - row.arm_a);
  row.point_a = row.center_a + Vec2(moved_a.x, moved_a.y) + row.arm_a;
  row.turned = (row.angle_b - row.angle_a) + (moved_b.turn - moved_a.turn);
  row.moved_a = moved_a.turn;
  row.moved_b = moved_b.turn;
  row.count = 0;
}

void JointRows::hold(Row& row, const Line& line, double off) const {
  row.held[row.count] = line;
  row.off[row.count] = off;
  ++row.count;
}

void JointRows::hold_point(Row& row) const {
  hold(row, Line::apart(Vec2(1, 0), -row.arm_a.y(), -row.arm_b.y()), row.apart.x());
  hold(row, Line::apart(Vec2(0, 1), row.arm_a.x(), row.arm_b.x()), row.apart.y());
}

void JointRows::lay_out(Row& row, const Hinge&) const {
  hold_point(row);
  row.way.line = Line::turning(1, 1);
  row.way.position = row.turned;
  weigh(row);
  weigh(row, row.way);
}

void JointRows::lay_out(Row& row, const Weld& weld) const {
  hold_point(row);
  hold(row, Line::turning(1, 1), row.turned - weld.angle);
  weigh(row);
}

void JointRows::lay_out(Row& row, const Distance&) const {
  lay_out_distance(row);
}

void JointRows::lay_out(Row& row, const Spring&) const {
  lay_out_distance(row);
}

void JointRows::lay_out_distance(Row& row) const {
  const double length = row.way.position = row.apart.norm();
  const Vec2 along = length > 0 ? Vec2(row.apart / length) : Vec2(1, 0);
  row.way.line = Line::apart(along, cross(row.arm_a, along), cross(row.arm_b, along));
  weigh(row, row.way);
}

/// The line is fixed to a: a turn of a moves it where b is.
void JointRows::hold_on_line(Row& row, const Vec2& axis) const {
  const Vec2 along = Turn::of(row.turned_a) * axis.normalized(), across = quarter(along);
  const Vec2 arm = row.arm_a + row.apart;
  hold(row, Line::apart(across, cross(arm, across), cross(row.arm_b, across)), across.dot(row.apart));
  row.way.line = Line::apart(along, cross(arm, along), cross(row.arm_b, along));
  row.way.position = along.dot(row.apart);
}

void JointRows::lay_out(Row& row, const Slider& slider) const {
  hold_on_line(row, slider.axis);
  hold(row, Line::turning(1, 1), row.turned - slider.angle);
  weigh(row);
  weigh(row, row.way);
}

void JointRows::lay_out(Row& row, const Wheel& wheel) const {
  hold_on_line(row, wheel.axis);
  weigh(row);
  weigh(row, row.way);
  row.turning = Way{.line = Line::turning(1, 1), .position = row.turned};
  weigh(row, *row.turning);
}

void JointRows::lay_out(Row& row, const Pulley& pulley) const {
  const Vec2 rope_a = row.point_a - pulley.pulley_a, rope_b = row.point_a + row.apart - pulley.pulley_b;
  // A rope without length leads down.
  const auto away = [](const Vec2& rope, double length) { return length > 0 ? Vec2(rope / length) : Vec2(0, -1); };
  const double length_a = rope_a.norm(), length_b = rope_b.norm();
  const Vec2 along_a = -away(rope_a, length_a), along_b = pulley.ratio * away(rope_b, length_b);
  row.way.line = {along_a, along_b, cross(row.arm_a, along_a), cross(row.arm_b, along_b)};
  row.way.position = length_a + pulley.ratio * length_b;
  weigh(row, row.way);
}

void JointRows::lay_out(Row& row, const Gear& gear) const {
  const Joint& joint = *row.joint;
  hold(row, Line::turning(-gear.ratio, 1),
       gear.ratio * (joint.turned_a + row.moved_a) + (joint.turned_b + row.moved_b));
  weigh(row);
}

/// Factors the rows that hold.
void JointRows::weigh(Row& row) const {
  for (std::size_t i = 0; i < row.count; ++i)
    for (std::size_t k = 0; k <= i; ++k) {
      const double whole = coupling(row, row.held[i], row.held[k]);
      double entry = whole;
      for (std::size_t n = 0; n < k; ++n) entry -= row.root[i][n] * row.root[k][n];
      if (k < i)
        row.root[i][k] = row.root[k][k] > 0 ? entry / row.root[k][k] : 0;
      else
        row.root[i][i] = entry > new_enough * whole ? std::sqrt(entry) : 0;
    }
}

/// The inverse mass that remains along a coordinate.
void JointRows::weigh(const Row& row, Way& way) const {
  Held together{};
  for (std::size_t i = 0; i < row.count; ++i) together[i] = coupling(row, row.held[i], way.line);
  way.carried = solved(row, together);
  const double whole = coupling(row, way.line, way.line);
  double left = whole;
  for (std::size_t i = 0; i < row.count; ++i) {
    left -= together[i] * way.carried[i];
    way.carried[i] = -way.carried[i];
  }
  way.inverse_mass = left > new_enough * whole ? left : 0;
}

JointRows::Held JointRows::solved(const Row& row, Held right) {
  for (std::size_t i = 0; i < row.count; ++i) {
    for (std::size_t k = 0; k < i; ++k) right[i] -= row.root[i][k] * right[k];
    right[i] = row.root[i][i] > 0 ? right[i] / row.root[i][i] : 0;
  }
  for (std::size_t i = row.count; i-- > 0;) {
    for (std::size_t k = i + 1; k < row.count; ++k) right[i] -= row.root[k][i] * right[k];
    right[i] = row.root[i][i] > 0 ? right[i] / row.root[i][i] : 0;
  }
  return right;
}

void JointRows::begin_sub_step(const std::vector<BodyRow>& displacements, std::vector<BodyRow>& velocities) {
  for (Row& row : rows_) {
    place(row, displacements);
    std::visit([&](const auto& kind) { lay_out(row, kind); }, row.joint->settings.kind);
    Joint& joint = *row.joint;
    if (!(row.way.inverse_mass > 0)) joint.lower = joint.upper = joint.spring = 0;
    if (!((row.turning ? *row.turning : row.way).inverse_mass > 0)) joint.motor = 0;
    for (std::size_t i = 0; i < row.count; ++i) push(row, row.held[i], joint.held[i], velocities);
    push(row, row.way.line, along_way(row), velocities);
    if (row.turning) push(row, row.turning->line, joint.motor, velocities);
  }
}

/// Drives and bounds the coordinate; but not by the motor of a wheel.
double JointRows::along_way(const Row& row) {
  const Joint& joint = *row.joint;
  return (row.turning ? joint.spring : joint.motor) + joint.lower - joint.upper;
}

void JointRows::give(Row& row, const Way& way, double& impulse, double next, std::vector<BodyRow>& velocities) const {
  const double change = next - impulse;
  impulse = next;
  if (change == 0) return;
  push(row, way.line, change, velocities);
  for (std::size_t i = 0; i < row.count; ++i) {
    push(row, row.held[i], way.carried[i] * change, velocities);
    row.joint->held[i] += way.carried[i] * change;
  }
}

void JointRows::hold(Row& row, std::vector<BodyRow>& velocities, bool soft) const {
  Held speeds{};
  for (std::size_t i = 0; i < row.count; ++i)
    speeds[i] = speed_of(row, row.held[i], velocities) + (soft ? rate_ * row.off[i] : 0);
  const Held solution = solved(row, speeds);
  for (std::size_t i = 0; i < row.count; ++i) {
    double& impulse = row.joint->held[i];
    const double change = soft ? -firm_ * solution[i] - giving_ * impulse : -solution[i];
    push(row, row.held[i], change, velocities);
    impulse += change;
  }
}

/// Source: Catto, Soft Constraints, GDC 2011: an implicit spring on the mass that it moves.
double JointRows::drawn(const Way& way, double impulse, double speed, double error, double wanted, double hz,
                        double zeta) const {
  const double turn = 2 * std::numbers::pi * hz * h_, pull = turn * (2 * zeta + turn);
  if (!(pull > 0)) return 0;
  const double compliance = way.inverse_mass / pull, target = wanted - turn / (h_ * (2 * zeta + turn)) * error;
  return impulse + (target - speed - compliance * impulse) / (way.inverse_mass + compliance);
}

void JointRows::drive(Row& row, const Way& way, const Motor& motor, std::vector<BodyRow>& velocities) const {
  double& impulse = row.joint->motor;
  const double speed = speed_of(row, way.line, velocities), most = motor.max_force * h_;
  const double next =
      motor.position ? drawn(way, impulse, speed, way.position - *motor.position, motor.speed, motor.hz, motor.zeta)
                     : impulse + (motor.speed - speed) / way.inverse_mass;
  give(row, way, impulse, std::clamp(next, -most, most), velocities);
}

/// The spring of a wheel, toward where the points coincide.
void JointRows::suspend(Row& row, const Wheel& wheel, std::vector<BodyRow>& velocities) const {
  double& impulse = row.joint->spring;
  const double speed = speed_of(row, row.way.line, velocities);
  give(row, row.way, impulse, drawn(row.way, impulse, speed, row.way.position, 0, wheel.hz, wheel.zeta), velocities);
}

/// By the force at the end of the sub-step: -k (x + h v) - c v. Source: Catto, Soft Constraints, GDC 2011.
void JointRows::pull(Row& row, const Spring& spring, std::vector<BodyRow>& velocities) const {
  const double firmness = spring.damping + h_ * spring.stiffness;
  if (!(firmness > 0)) return;
  double& impulse = row.joint->motor;
  const double compliance = 1 / (h_ * firmness),
               wanted = (spring.length - row.way.position) * (spring.stiffness / firmness);
  const double speed = speed_of(row, row.way.line, velocities);
  const double change = (wanted - speed - compliance * impulse) / (row.way.inverse_mass + compliance);
  give(row, row.way, impulse, impulse + change, velocities);
}

/// Remaining room may be used up within the sub-step; excess is removed softly, or as by a spring.
void JointRows::bound(Row& row, const Limits& limits, std::vector<BodyRow>& velocities, bool soft) const {
  const bool spring = limits.hz > 0, fixed = limits.low == limits.high && !spring;
  const auto stop = [&](double& impulse, double room, double sign) {
    if (!std::isfinite(room)) return;
    const double speed = sign * speed_of(row, row.way.line, velocities);
    double next = 0;
    if (spring && room <= 0) {
      next = drawn(row.way, impulse, speed, room, 0, limits.hz, limits.zeta);
    } else if (!spring) {
      const bool free = room > 0 && !fixed;
      const double wanted = free ? room / h_ : soft ? rate_ * room : 0;
      const double firm = free || !soft ? 1 : firm_, giving = free || !soft ? 0 : giving_;
      next = (1 - giving) * impulse - firm * (speed + wanted) / row.way.inverse_mass;
    }
    if (!fixed) next = std::max(0.0, next);
    double along = sign * impulse;
    give(row, row.way, along, sign * next, velocities);
    impulse = next;
  };
  stop(row.joint->lower, row.way.position - limits.low, 1);
  if (!fixed) stop(row.joint->upper, limits.high - row.way.position, -1);
}

void JointRows::solve(std::vector<BodyRow>& velocities, bool soft) {
  for (Row& row : rows_) {
    hold(row, velocities, soft);
    const JointKind& kind = row.joint->settings.kind;
    if (const auto* const wheel = std::get_if<Wheel>(&kind); wheel && wheel->motor && row.turning->inverse_mass > 0)
      drive(row, *row.turning, *wheel->motor, velocities);
    if (!(row.way.inverse_mass > 0)) continue;
    const auto move = [&](const auto& its) {
      if (its.motor) drive(row, row.way, *its.motor, velocities);
      if (its.limits) bound(row, *its.limits, velocities, soft);
    };
    if (const auto* const hinge = std::get_if<Hinge>(&kind)) move(*hinge);
    if (const auto* const slider = std::get_if<Slider>(&kind)) move(*slider);
    if (const auto* const distance = std::get_if<Distance>(&kind)) bound(row, distance->limits, velocities, soft);
    if (const auto* const spring = std::get_if<Spring>(&kind)) pull(row, *spring, velocities);
    if (const auto* const wheel = std::get_if<Wheel>(&kind)) {
      suspend(row, *wheel, velocities);
      if (wheel->suspension) bound(row, *wheel->suspension, velocities, soft);
    }
    if (const auto* const pulley = std::get_if<Pulley>(&kind))
      bound(row, {-std::numeric_limits<double>::infinity(), *pulley->length}, velocities, soft);
  }
}

void JointRows::end_sub_step() {
  for (Row& row : rows_) {
    Joint& joint = *row.joint;
    // Forces act at b's point, about which they turn nothing.
    const auto add = [&](const Line& line, double impulse) {
      joint.total += impulse * line.along_b;
      if (line.along_b == Vec2::Zero()) joint.total_turn += impulse * line.turn_b;
    };
    for (std::size_t i = 0; i < row.count; ++i) add(row.held[i], joint.held[i]);
    add(row.way.line, along_way(row));
    if (row.turning) add(row.turning->line, joint.motor);
  }
}

void JointRows::end_step(const std::vector<BodyRow>& displacements) {
  for (Row& row : rows_) {
    if (!std::holds_alternative<Gear>(row.joint->settings.kind)) continue;
    row.joint->turned_a += displacements[row.a].turn;
    row.joint->turned_b += displacements[row.b].turn;
  }
}

void JointRows::keep(double times) {
  if (times == 1) return;
  for (const Row& row : rows_) {
    Joint& joint = *row.joint;
    const auto kept = [times](double before, double now) { return times > 0 ? times * now : before; };
    for (std::size_t i = 0; i < joint.held.size(); ++i) joint.held[i] = kept(row.held_before[i], joint.held[i]);
    joint.motor = kept(row.motor_before, joint.motor);
    joint.spring = kept(row.spring_before, joint.spring);
    joint.lower = kept(row.lower_before, joint.lower);
    joint.upper = kept(row.upper_before, joint.upper);
  }
}

}  // namespace tweenfall::planar::inner
