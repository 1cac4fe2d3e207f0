#include "step/solver.h"

#include <tweenfall/curves/rotation.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "contacts/meeting.h"
#include "forces/drive_law.h"
#include "islands/pinched.h"
#include "step/contact_rows.h"

namespace tweenfall::step {

using forces::Load;
using state::Body;

namespace {

/// Points whose gaps differ by less than this meet at the same time, m.
constexpr double beside = 1e-3;
/// Impulses are kept from sub-steps of at least this part of the length of the last one kept: the impulses of shorter
/// ones are mostly rounding, which would grow with the ratio of lengths.
constexpr double long_enough = 0.5;

/// For bodies that are not in the island.
constexpr std::uint32_t nowhere = 0xffffffffu;

bool pulls_without_limit(const Body& body) {
  return body.drive.owner() == Owner::driven && std::isinf(body.drive.max_force) && std::isinf(body.drive.max_torque);
}

bool bounds_spin(const Body& body, const SolverBody& entry, double h) {
  return entry.angular.norm() * h > 1 || body.slender();
}

}  // namespace

void Solver::begin(std::size_t bodies, double parts) {
  parts_ = parts;
  bodies_.clear();
  slots_.assign(bodies, nowhere);
}

void Solver::gather(const std::vector<Body>& bodies, std::span<contacts::ContactConstraint* const> contacts,
                    Springs springs, double dt) {
  for (const SolverBody& body : bodies_) slots_[body.index] = nowhere;
  bodies_.clear();
  led_.clear();
  heaviest_ = 0;
  lightest_ = std::numeric_limits<double>::infinity();
  const auto add = [&](std::uint32_t index) {
    if (slots_[index] != nowhere) return;
    slots_[index] = static_cast<std::uint32_t>(bodies_.size());
    const Body& body = bodies[index];
    SolverBody entry;
    entry.index = index;
    entry.round = body.round();
    entry.movable = !body.immovable() && !body.asleep;
    entry.conveys = body.conveys;
    if (body.conveys) entry.surface = body.surface();
    entry.center = entry.start_center = body.center;
    entry.rotation = entry.start_rotation = body.motion.pose.rotation;
    entry.turn = Quat::Identity();
    entry.drive_impulse = entry.drive_angular_impulse = Vec3::Zero();
    if (entry.movable) {
      heaviest_ = std::max(heaviest_, body.mass().mass);
      lightest_ = std::min(lightest_, body.mass().mass);
      entry.inverse_mass = 1 / body.mass().mass;
      entry.inverse_inertia = body.world_inverse_inertia(body.motion.pose.rotation);
      entry.linear = body.twist.linear;
      entry.angular = body.twist.angular;
    } else if (body.immovable()) {
      const KeyedCourse course = keyed_course(body, dt);
      if (!course.still()) {
        entry.led = static_cast<std::uint32_t>(led_.size());
        const Twist start = course.velocity(0, dt);
        led_.push_back({slots_[index], course, start, start});
        entry.linear = start.linear;
        entry.angular = start.angular;
      }
    }
    bodies_.push_back(entry);
  };
  for (const contacts::ContactConstraint* contact : contacts) {
    add(contact->a);
    add(contact->b);
  }
  for (const SpringRow* spring : springs)
    for (const std::uint32_t end : {spring->a, spring->b}) {
      if (end == SpringRow::world) continue;
      add(end);
      at(end).sprung = at(end).touched = at(end).movable;
    }
  starts_.resize(bodies_.size());
}

void Solver::meet(const std::vector<Load>& loads, SolvedContact& constraint, double h, double whole) const {
  const SolverBody& a = at(constraint.a);
  const SolverBody& b = at(constraint.b);
  const Vec3& normal = constraint.normal;
  // Forces change the velocity of the center on the way, and a spin changes by itself: what is left of it counts.
  const Vec3 linear = starts_[slots_[constraint.a]].linear - starts_[slots_[constraint.b]].linear;
  const auto [pull, tremble] = contacts::closing_of(normal, loads[constraint.a], loads[constraint.b], whole);
  constraint.rebounds = false;
  for (int i = 0; i < constraint.count; ++i) {
    SolvedPoint& point = constraint.points[static_cast<std::size_t>(i)];
    point.rebound = point.rebound_time = 0;
    const double closing = normal.dot(linear + a.angular.cross(point.arm_a) - b.angular.cross(point.arm_b));
    const auto [time, speed] = contacts::meeting_of(point.gap, closing, pull, h);
    if (!(speed > tremble)) continue;
    point.approach = std::max(point.approach, speed);
    const double left = h - time;
    const double back = constraint.restitution * speed;
    const double speed_at_end = back - pull * left;
    if (back <= 0 || speed_at_end <= 0) continue;
    point.rebound = speed_at_end;
    point.rebound_time = left * (back - 0.5 * pull * left) / speed_at_end;
  }
}

void Solver::refresh(SolvedContact& constraint) const {
  const SolverBody& a = at(constraint.a);
  const SolverBody& b = at(constraint.b);
  const Vec3& normal = constraint.normal;
  const Vec3 drift = (b.center - b.start_center) - (a.center - a.start_center);
  for (int i = 0; i < constraint.count; ++i) {
    SolvedPoint& point = constraint.points[static_cast<std::size_t>(i)];
    point.arm_a = state::carried(a.turn, point.start_arm_a, point.skin_a * normal);
    point.arm_b = state::carried(b.turn, point.start_arm_b, -point.skin_b * normal);
    const Vec3 swing = (point.arm_b - point.start_arm_b) - (point.arm_a - point.start_arm_a);
    point.gap = point.start_gap + normal.dot(drift + swing);
  }
}

void Solver::begin_sub_step(const std::vector<Body>& bodies, const std::vector<Load>& loads,
                            const WorldSettings& settings, double h, int sub_step) {
  lead(h, sub_step);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    SolverBody& entry = bodies_[i];
    entry.pressed = false;
    SubStepStart& start = starts_[i];
    start.center = entry.center;
    start.rotation = entry.rotation;
    if (entry.led != not_led) continue;
    start.linear = entry.linear;
    start.angular = entry.angular;
    if (!entry.movable) continue;
    const Body& body = bodies[entry.index];
    const Load& load = loads[entry.index];
    entry.linear = forces::accelerated(entry.linear, load, settings.integrator, h);
    const forces::Spin spin = forces::turned(body, {entry.rotation, entry.angular}, load, h);
    entry.angular = spin.angular;
    entry.free_rotation = spin.rotation;
    entry.inverse_inertia = body.world_inverse_inertia(spin.rotation);
    if (!pulls_without_limit(body)) continue;
    // Implicit in the pull: contacts, too, have to move what it holds.
    const forces::DriveLaw law =
        forces::drive_law(body, entry.center, entry.rotation, h, (sub_steps_ - sub_step - 1) * h);
    entry.pulled = true;
    const double given = 1 / (1 + law.stiffness);
    entry.linear = given * (entry.linear + law.linear);
    entry.angular = given * (entry.angular + law.angular);
    entry.inverse_mass = given / body.mass().mass;
    entry.inverse_inertia *= given;
  }
}

/// A led body moves through the sub-step by its mean velocity, so that it is where its path is at the end.
void Solver::lead(double h, int sub_step) {
  const double dt = h * sub_steps_;
  const double from = static_cast<double>(sub_step) / sub_steps_;
  const double to = static_cast<double>(sub_step + 1) / sub_steps_;
  for (LedBody& led : led_) {
    SolverBody& entry = bodies_[led.place];
    starts_[led.place].linear = led.ending.linear;
    starts_[led.place].angular = led.ending.angular;
    led.mean = led.course.mean_between(from, to, dt);
    led.ending = led.course.velocity(to, dt);
    entry.linear = led.mean.linear;
    entry.angular = led.mean.angular;
  }
}

/// Afterwards the bodies it carries get the velocity at the end.
void Solver::end_lead() {
  for (const LedBody& led : led_) {
    bodies_[led.place].linear = led.ending.linear;
    bodies_[led.place].angular = led.ending.angular;
  }
  if (led_.empty()) return;
  for (PointRows& rows : rows_) {
    rows.drift1 = rows.later_drift1;
    rows.drift2 = rows.later_drift2;
  }
}

void Solver::ride(const SolvedContact& constraint, const SolvedPoint& point, PointRows& rows, double h) const {
  const SolverBody& a = at(constraint.a);
  const SolverBody& b = at(constraint.b);
  const bool on_a = a.led != not_led;
  if (!on_a && b.led == not_led) return;
  const SolverBody& body = on_a ? b : a;
  const SolverBody& carrier = on_a ? a : b;
  const SubStepStart& start = starts_[slots_[body.index]];
  const Vec3 arm = on_a ? point.arm_b : point.arm_a;
  const Vec3 skin = on_a ? Vec3(-point.skin_b * constraint.normal) : Vec3(point.skin_a * constraint.normal);
  const bool rolls = body.round && !body.impact && !body.sprung && !body.pulled;
  const SlipOfRider slip =
      slip_of_rider(led_[carrier.led], on_a ? point.arm_a : point.arm_b,
                    {{start.linear, start.angular}, arm - skin, body.center + arm - carrier.center, rolls}, h);
  rows.drift_by(on_a ? slip.moving : Vec3(-slip.moving), on_a ? slip.after : Vec3(-slip.after));
}

/// Points that press, or are about to, get the same height: at different heights, however close, friction that lets
/// none of them slip would also hold the body's tilt, against the normals.
void Solver::level(SolvedContact& constraint) {
  const std::span<SolvedPoint> points(constraint.points.data(), static_cast<std::size_t>(constraint.count));
  double pressing = 0, least_gap = std::numeric_limits<double>::infinity();
  for (const SolvedPoint& point : points) {
    pressing += point.kept_normal;
    least_gap = std::min(least_gap, point.gap);
  }
  double sum = 0, height_a = 0, height_b = 0;
  for (const SolvedPoint& point : points) {
    const double weight = pressing > 0 ? point.kept_normal : point.gap < least_gap + beside ? 1 : 0;
    sum += weight;
    height_a += weight * constraint.normal.dot(point.arm_a);
    height_b += weight * constraint.normal.dot(point.arm_b);
  }
  for (SolvedPoint& point : points) {
    if (pressing == 0 && !(point.gap < least_gap + beside)) continue;
    point.arm_a += (height_a / sum - constraint.normal.dot(point.arm_a)) * constraint.normal;
    point.arm_b += (height_b / sum - constraint.normal.dot(point.arm_b)) * constraint.normal;
  }
}

void Solver::warm_start(SolvedContact& constraint, PointRows* rows, const Softness& softness, double h) {
  SolverBody& a = at(constraint.a);
  SolverBody& b = at(constraint.b);
  const Vec3& normal = constraint.normal;
  const double ratio = constraint.kept_step > h ? h / constraint.kept_step : 1;
  const Tangents along = constraint.friction > 0 ? tangents_of(normal) : Tangents{};
  if (extrapolating_ && constraint.friction > 0 && constraint.count > 1) level(constraint);
  for (int i = 0; i < constraint.count; ++i) {
    SolvedPoint& point = constraint.points[static_cast<std::size_t>(i)];
    rows[i].prepare(a, b, point, normal, constraint.friction > 0 ? &along : nullptr);
    if (constraint.friction > 0 && !led_.empty()) ride(constraint, point, rows[i], h);
    // A contact may bear a load far greater than the two masses that meet in it.
    const double stiffness = softness.firm / softness.giving *
                             (extrapolating_ ? std::max(1.0, heaviest_ * rows[i].scale * rows[i].scale) : 1.0);
    rows[i].firm = stiffness / (1 + stiffness);
    point.normal_impulse = ratio * point.kept_normal;
    point.friction_impulse = ratio * (point.kept_friction - normal * normal.dot(point.kept_friction));
    const Vec3 impulse = point.normal_impulse * normal + point.friction_impulse;
    if (impulse == Vec3::Zero()) continue;
    push(a, -impulse, point.arm_a);
    push(b, impulse, point.arm_b);
  }
  constraint.rolling_impulse = ratio * constraint.kept_rolling;
  a.angular -= a.inverse_inertia * constraint.rolling_impulse;
  b.angular += b.inverse_inertia * constraint.rolling_impulse;
  constraint.spin_impulse = ratio * constraint.kept_spin;
  if (constraint.spin_impulse == 0) return;
  a.angular -= a.inverse_inertia * (constraint.spin_impulse * normal);
  b.angular += b.inverse_inertia * (constraint.spin_impulse * normal);
}

double Solver::solve_contact(SolvedContact& constraint, const PointRows* rows, const Softness& softness, double h) {
  SolverBody& a = at(constraint.a);
  SolverBody& b = at(constraint.b);
  const Vec3& normal = constraint.normal;
  double change = 0;
  if (constraint.rolling_friction > 0 || constraint.spinning_friction > 0) {
    double sum = 0;
    for (int i = 0; i < constraint.count; ++i) sum += constraint.points[static_cast<std::size_t>(i)].normal_impulse;
    if (constraint.rolling_friction > 0)
      solve_rolling(a, b, constraint.rolling_impulse, constraint.rolling_friction * sum);
    if (constraint.spinning_friction > 0)
      solve_spinning(a, b, normal, constraint.spin_impulse, constraint.spinning_friction * sum);
  }
  if (constraint.friction > 0) {
    for (int i = 0; i < constraint.count; ++i) {
      SolvedPoint& point = constraint.points[static_cast<std::size_t>(i)];
      if (point.normal_impulse == 0 && point.friction_impulse == Vec3::Zero()) continue;
      change = std::max(
          change, solve_friction(a, b, rows[i], point.friction_impulse, constraint.friction * point.normal_impulse));
    }
  }
  for (int i = 0; i < constraint.count; ++i) {
    SolvedPoint& point = constraint.points[static_cast<std::size_t>(i)];
    // A gap may close within the sub-step, but not further.
    const bool soft = softness.giving > 0 && point.gap <= 0 && !constraint.impact && !a.pulled && !b.pulled;
    const double wanted = point.gap > 0 ? -point.gap / h : std::min(-softness.rate * point.gap, softness.speed);
    point.wanted = wanted;
    point.firm = soft ? rows[i].firm : 1;
    change = std::max(change, solve_normal(a, b, rows[i], point.normal_impulse, wanted, normal, point.firm));
  }
  return change;
}

double Solver::solve_drive(const std::vector<Body>& bodies, SolverBody& entry, double h, double remaining) {
  const Body& body = bodies[entry.index];
  if (!entry.movable || body.drive.owner() != Owner::driven || pulls_without_limit(body)) return 0;
  const forces::DriveLaw law = forces::drive_law(body, entry.center, entry.rotation, h, remaining);
  // Velocity as it would be without the pull: contacts included, the drive's own impulse removed.
  const Vec3 linear = entry.linear - entry.inverse_mass * entry.drive_impulse;
  Vec3 impulse = ((linear + law.linear) / (1 + law.stiffness) - linear) / entry.inverse_mass;
  const double most = body.drive.max_force * h;
  entry.saturated = impulse.norm() > most;
  if (entry.saturated) impulse *= most / impulse.norm();
  const double change = entry.inverse_mass * (impulse - entry.drive_impulse).norm();
  entry.drive_impulse = impulse;
  entry.linear = linear + entry.inverse_mass * impulse;

  const Vec3 angular = entry.angular - entry.inverse_inertia * entry.drive_angular_impulse;
  const Mat3 inertia = body.world_inertia(entry.start_rotation);
  Vec3 turning = inertia * ((angular + law.angular) / (1 + law.stiffness) - angular);
  const double most_turning = body.drive.max_torque * h;
  if (turning.norm() > most_turning) {
    entry.saturated = true;
    turning *= most_turning / turning.norm();
  }
  entry.drive_angular_impulse = turning;
  entry.angular = angular + entry.inverse_inertia * turning;
  return change;
}

double Solver::pass(Contacts contacts, const Softness& softness, double h, bool backward) {
  double change = 0;
  const std::size_t count = contacts.size();
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t i = backward ? count - 1 - n : n;
    change = std::max(change, solve_contact(contacts[i], &rows_[4 * i], softness, h));
  }
  return change;
}

/// Where a contact holds a body, the velocity after the impulses counts: a mean would leave all jitter undamped.
void Solver::find_lags(Contacts contacts) {
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    bodies_[i].lag = bodies_[i].movable ? Vec3(0.5 * (starts_[i].linear - bodies_[i].linear)) : Vec3(0, 0, 0);
  for (const SolvedContact& contact : contacts) {
    const SolvedContact& constraint = contact;
    for (int i = 0; i < constraint.count; ++i) {
      const SolvedPoint& point = constraint.points[static_cast<std::size_t>(i)];
      if (point.normal_impulse == 0) continue;
      const double grip = constraint.friction * point.normal_impulse;
      const bool slides = point.friction_impulse.squaredNorm() >= 0.999 * grip * grip;
      for (SolverBody* body : {&at(constraint.a), &at(constraint.b)}) {
        body->pressed = body->touched = true;
        if (slides || body->round)
          body->lag -= constraint.normal * constraint.normal.dot(body->lag);
        else
          body->lag = Vec3::Zero();
      }
    }
  }
  for (SolverBody& body : bodies_)
    if (body.sprung || body.pulled || (body.impact && body.pressed)) body.lag = Vec3::Zero();
}

void Solver::add_totals(Contacts contacts, double h) {
  const double whole = kept_as_whole(parts_);
  for (SolvedContact& contact : contacts) {
    SolvedContact& constraint = contact;
    bool any = false;
    for (int i = 0; i < constraint.count; ++i) {
      SolvedPoint& point = constraint.points[static_cast<std::size_t>(i)];
      point.total_normal += point.normal_impulse;
      point.total_friction += point.friction_impulse;
      any = any || point.normal_impulse != 0 || point.friction_impulse != Vec3::Zero();
    }
    constraint.total_rolling += constraint.rolling_impulse;
    // A body that only the last pass reached also got momentum from it.
    if (any) at(constraint.a).touched = at(constraint.b).touched = true;
    // A blow says nothing about the forces after it.
    if (constraint.rebounds) continue;
    if (h < long_enough * constraint.kept_step) {
      constraint.passed_over += h;
      if (constraint.passed_over < sub_steps_ * constraint.kept_step || whole < parts_) continue;
    }
    for (int i = 0; i < constraint.count; ++i) {
      SolvedPoint& point = constraint.points[static_cast<std::size_t>(i)];
      point.kept_normal = whole * point.normal_impulse;
      point.kept_friction = whole * point.friction_impulse;
    }
    constraint.kept_rolling = whole * constraint.rolling_impulse;
    constraint.kept_spin = whole * constraint.spin_impulse;
    constraint.kept_step = whole * h;
    constraint.passed_over = 0;
  }
}

void Solver::end_sub_step(double h) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    SolverBody& entry = bodies_[i];
    // Under steady forces the mean velocity is exact.
    const Vec3 linear = entry.linear + entry.lag;
    Vec3 angular = entry.angular;
    entry.center += linear * h;
    const bool left_alone = entry.movable && !entry.sprung && !entry.pulled && entry.drive_angular_impulse.isZero(0);
    Quat turn;
    if (left_alone && !entry.pressed) {
      // The spin of free flight keeps its energy only with the rotation that belongs to it.
      turn = entry.free_rotation * entry.rotation.conjugate();
      entry.rotation = entry.free_rotation;
    } else {
      if (left_alone && entry.round && !entry.impact) angular = 0.5 * (angular + starts_[i].angular);
      if (angular == Vec3::Zero()) continue;
      turn = exp_map(angular * h);
      entry.rotation = turn * entry.rotation;
      entry.rotation.normalize();
    }
    entry.turn = turn * entry.turn;
    entry.turn.normalize();
  }
}

/// Impulses are computed for the inertia at the end of free flight, but the body then turns otherwise. Carried along
/// with it, its spin keeps its energy: a rolling capsule that also turns about the vertical would otherwise spin ever
/// faster.
void Solver::carry_spins(const std::vector<Body>& bodies, double h) {
  for (SolverBody& entry : bodies_) {
    const Body& body = bodies[entry.index];
    const bool left_alone = entry.movable && !entry.sprung && !entry.pulled && entry.drive_angular_impulse.isZero(0);
    if (!left_alone || !entry.pressed || body.spherical() || bounds_spin(body, entry, h)) continue;
    entry.angular = entry.rotation * (entry.free_rotation.conjugate() * entry.angular);
  }
}

/// In turns of more than a radian, and in any of a rod, a spin that is carried along could be any: its energy is
/// bounded, or it would grow until nothing is finite.
void Solver::bound_spins(const std::vector<Body>& bodies, double h) {
  for (SolverBody& entry : bodies_) {
    const Body& body = bodies[entry.index];
    if (!entry.movable || entry.pulled || body.spherical() || !bounds_spin(body, entry, h)) continue;
    const double energy = 0.5 * entry.angular.dot(entry.inverse_inertia.inverse() * entry.angular);
    entry.angular = forces::bounded_spin(body.world_inertia(entry.rotation), energy, entry.angular);
  }
}

void Solver::solve(std::vector<Body>& bodies, const std::vector<Load>& loads,
                   std::span<contacts::ContactConstraint* const> found, Springs springs, const WorldSettings& settings,
                   double dt, std::vector<char>& moved, int sub_steps, bool rough) {
  sub_steps_ = sub_steps;
  gather(bodies, found, springs, dt);
  contacts_.clear();
  contacts_.reserve(found.size());
  for (contacts::ContactConstraint* contact : found) {
    const SolverBody& a = at(contact->a);
    const SolverBody& b = at(contact->b);
    const contacts::Closing closing =
        contacts::closing_of(contact->manifold.normal, loads[contact->a], loads[contact->b], dt * parts_);
    contacts::foresee(*contact, {a.linear, a.angular}, {b.linear, b.angular}, closing, dt);
    if (contact->impact) at(contact->a).impact = at(contact->b).impact = true;
    contacts_.emplace_back(*contact);
  }
  const Contacts contacts = contacts_;
  rows_.resize(4 * contacts.size());
  const double h = dt / sub_steps_;
  const bool thorough = contacts.size() <= to_the_end;
  const int share = thorough ? settings.iterations : settings.iterations / sub_steps_;
  const int relaxing = std::max(1, share / 2);
  const int passes = std::max(1, share - relaxing);
  const Softness hard;
  const Softness soft = soft_contacts(settings.push_out_speed, dt, sub_steps_, parts_);
  // Between two bodies that wedge it, no push is enough.
  extrapolating_ = !rough && extrapolates(bodies, springs) && !islands::is_wedged(found, bodies, soft.deep());
  for (int sub_step = 0; sub_step < sub_steps_; ++sub_step) {
    begin_sub_step(bodies, loads, settings, h, sub_step);
    for (SolvedContact& contact : contacts) {
      if (sub_step > 0) refresh(contact);
      if (contact.restitution > 0) meet(loads, contact, h, dt * parts_);
    }
    for (std::size_t i = 0; i < contacts.size(); ++i) warm_start(contacts[i], &rows_[4 * i], soft, h);
    for (SpringRow* spring : springs) spring->begin(end_of(spring->a), end_of(spring->b), h);
    const double remaining = dt - (sub_step + 1) * h;
    for (SolverBody& body : bodies_) body.drive_impulse = body.drive_angular_impulse = Vec3::Zero();
    const auto all = [&](const Softness& softness, bool backward) {
      double change = 0;
      for (SpringRow* spring : springs) change = std::max(change, spring->solve(end_of(spring->a), end_of(spring->b)));
      for (SolverBody& body : bodies_) change = std::max(change, solve_drive(bodies, body, h, remaining));
      return std::max(change, pass(contacts, softness, h, backward));
    };
    settle(passes, [&](bool backward) { return all(soft, backward); });
    find_lags(contacts);
    end_sub_step(h);
    end_lead();
    settle(relaxing, [&](bool backward) { return all(hard, backward); });
    carry_spins(bodies, h);
    rebound(bodies, loads, contacts, thorough ? settings.iterations : std::max(1, settings.iterations / 4));
    bound_spins(bodies, h);
    add_totals(contacts, h);
  }

  for (const SolvedContact& contact : contacts) contact.store();
  for (SolverBody& entry : bodies_) {
    if (!entry.movable || !entry.touched) continue;
    Body& body = bodies[entry.index];
    body.center = entry.center;
    body.twist = {entry.linear, entry.angular};
    body.saturated = entry.saturated;
    body.follow_center(entry.rotation);
    moved[entry.index] = 1;
  }
}

}  // namespace tweenfall::step
