#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "islands/island_energy.h"
#include "step/contact_rows.h"
#include "step/solver.h"

namespace tweenfall::step {

using state::Body;

namespace {

/// A change of velocity by the rebound that no longer matters, m/s.
constexpr double quiet = 1e-14;

/// Whether a point that should rebound was reached.
bool rebounds(const SolvedContact& contact) {
  for (int i = 0; i < contact.count; ++i) {
    const SolvedPoint& point = contact.points[static_cast<std::size_t>(i)];
    if (point.rebound > 0 && point.normal_impulse > 0) return true;
  }
  return false;
}

/// What the rebound added to the impulses of a contact's points. Four points in one plane can press in more than one
/// way with the same effect: of these ways, the one that spreads the impulse most evenly, in whatever order they were
/// solved.
std::array<double, 4> gained(const SolvedContact& contact) {
  std::array<double, 4> gain{};
  const auto count = static_cast<std::size_t>(contact.count);
  for (std::size_t i = 0; i < count; ++i)
    gain[i] = contact.points[i].normal_impulse - contact.points[i].normal_before_rebound;
  if (count < 4) return gain;
  // Combinations without effect, by Cramer's rule: the share of each point is the area that the other three span.
  std::array<double, 4> idle{};
  double along = 0, square = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 &first = contact.points[(i + 1) % 4].arm_a, &second = contact.points[(i + 2) % 4].arm_a,
               &third = contact.points[(i + 3) % 4].arm_a;
    const double area = contact.normal.dot((second - first).cross(third - first));
    idle[i] = i % 2 == 0 ? area : -area;
    along += idle[i] * gain[i];
    square += idle[i] * idle[i];
  }
  if (square > 0)
    for (std::size_t i = 0; i < 4; ++i) gain[i] -= along / square * idle[i];
  return gain;
}

}  // namespace

double Solver::rebound_pass(Contacts contacts, bool backward) {
  double most = 0;
  const std::size_t count = contacts.size();
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t index = backward ? count - 1 - n : n;
    SolvedContact& constraint = contacts[index];
    const PointRows* rows = &rows_[4 * index];
    SolverBody& a = at(constraint.a);
    SolverBody& b = at(constraint.b);
    // Only what the rebound reaches.
    if (!(a.stirred || b.stirred)) continue;
    const Vec3& normal = constraint.normal;
    double change = 0;
    for (int i = 0; i < constraint.count; ++i) {
      SolvedPoint& point = constraint.points[static_cast<std::size_t>(i)];
      if (constraint.friction > 0 && constraint.impact)
        change = std::max(
            change, solve_friction(a, b, rows[i], point.friction_impulse, constraint.friction * point.normal_impulse));
      point.wanted = point.rebound;
      point.firm = point.normal_impulse == 0 && point.gap > 0 ? 0 : 1;
      if (point.firm == 0) continue;
      change = std::max(change, solve_normal(a, b, rows[i], point.normal_impulse, point.rebound, normal));
    }
    if (change > quiet) {
      a.stirred = a.movable;
      b.stirred = b.movable;
    }
    most = std::max(most, change);
  }
  return most;
}

/// The rebound began inside the sub-step: for the rest of the sub-step, it moved the bodies.
void Solver::move_by_rebound(const SolvedContact& constraint, const PointRows* rows) {
  SolverBody& a = at(constraint.a);
  SolverBody& b = at(constraint.b);
  const std::array<double, 4> gain = gained(constraint);
  for (int i = 0; i < constraint.count; ++i) {
    const SolvedPoint& point = constraint.points[static_cast<std::size_t>(i)];
    if (!(point.rebound > 0)) continue;
    // Bodies still closing when it was solved are on the surface already: stopping them moves nothing.
    const double part = point.rebound / (point.rebound - std::min(0.0, point.speed_before_rebound));
    // A rebound that gravity nearly uses up lasts long and takes little impulse: what neighbors pass on through the
    // point is not part of it.
    const double most = rows[i].mass * point.rebound;
    const double own = std::clamp(gain[static_cast<std::size_t>(i)] * part, -most, most);
    const Vec3 moved = own * point.rebound_time * constraint.normal;
    if (moved == Vec3::Zero()) continue;
    const auto move = [](SolverBody& body, const Vec3& by, const Vec3& arm) {
      body.center += body.inverse_mass * by;
      body.rebound_turn += body.inverse_inertia * arm.cross(by);
    };
    move(a, -moved, point.arm_a);
    move(b, moved, point.arm_b);
  }
}

/// Takes back as much of the rebound as would leave the island with more energy than it had and was given.
void Solver::bound_energy(const std::vector<Body>& bodies, const std::vector<forces::Load>& loads, Contacts contacts) {
  islands::IslandEnergy energy;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const SolverBody& entry = bodies_[i];
    if (!entry.movable) continue;
    const Body& body = bodies[entry.index];
    const SubStepStart& start = starts_[i];
    // The work of a drive or a stiff spring is not known: the island is left as it is.
    if (entry.sprung || body.drive.owner() == Owner::driven) return;
    islands::BodyCourse course;
    course.start = {start.linear, start.angular};
    course.start_center = start.center;
    course.start_rotation = start.rotation;
    course.before = {start.linear_before_rebound, start.angular_before_rebound};
    course.after = {entry.linear, entry.angular};
    course.center = entry.center;
    course.rotation = entry.rotation;
    energy.add(body, loads[entry.index], course);
  }
  // A body that moves by its own will does work on what it pushes.
  for (const SolvedContact& contact : contacts) {
    const SolvedContact& constraint = contact;
    const SolverBody& a = at(constraint.a);
    const SolverBody& b = at(constraint.b);
    // So does a moving surface.
    if (a.conveys || b.conveys)
      for (int i = 0; i < constraint.count; ++i) {
        const SolvedPoint& point = constraint.points[static_cast<std::size_t>(i)];
        energy.limit -= point.friction_impulse.dot(drift_at(a.surface, point.arm_a, b.surface, point.arm_b));
      }
    if (a.movable == b.movable) continue;
    for (int i = 0; i < constraint.count; ++i) {
      const SolvedPoint& point = constraint.points[static_cast<std::size_t>(i)];
      const Vec3 impulse = point.normal_impulse * constraint.normal + point.friction_impulse;
      energy.limit +=
          a.movable ? -impulse.dot(point_velocity(b, point.arm_b)) : impulse.dot(point_velocity(a, point.arm_a));
    }
  }
  const double share = energy.share_within();
  if (share == 1) return;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    SolverBody& entry = bodies_[i];
    if (!entry.movable) continue;
    entry.linear = starts_[i].linear_before_rebound + share * (entry.linear - starts_[i].linear_before_rebound);
    entry.angular = starts_[i].angular_before_rebound + share * (entry.angular - starts_[i].angular_before_rebound);
  }
  for (SolvedContact& contact : contacts)
    for (int i = 0; i < contact.count; ++i) {
      SolvedPoint& point = contact.points[static_cast<std::size_t>(i)];
      point.normal_impulse = point.normal_before_rebound + share * (point.normal_impulse - point.normal_before_rebound);
      point.friction_impulse =
          point.friction_before_rebound + share * (point.friction_impulse - point.friction_before_rebound);
    }
}

void Solver::rebound(const std::vector<Body>& bodies, const std::vector<forces::Load>& loads, Contacts contacts,
                     int passes) {
  const bool any = std::any_of(contacts.begin(), contacts.end(), rebounds);
  for (SolvedContact& contact : contacts) contact.rebounds = any;
  if (!any) return;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    bodies_[i].stirred = false;
    starts_[i].linear_before_rebound = bodies_[i].linear;
    starts_[i].angular_before_rebound = bodies_[i].angular;
  }
  for (SolvedContact& contact : contacts) {
    SolverBody& a = at(contact.a);
    SolverBody& b = at(contact.b);
    for (int i = 0; i < contact.count; ++i) {
      SolvedPoint& point = contact.points[static_cast<std::size_t>(i)];
      point.normal_before_rebound = point.normal_impulse;
      point.friction_before_rebound = point.friction_impulse;
      point.speed_before_rebound = contact.normal.dot(point_velocity(b, point.arm_b) - point_velocity(a, point.arm_a));
      if (!(point.rebound > 0 && point.normal_impulse > 0)) continue;
      a.stirred = a.stirred || a.movable;
      b.stirred = b.stirred || b.movable;
    }
  }
  settle(passes, [&](bool backward) { return rebound_pass(contacts, backward); });
  for (SolverBody& body : bodies_) body.rebound_turn = Vec3::Zero();
  for (std::size_t i = 0; i < contacts.size(); ++i) move_by_rebound(contacts[i], &rows_[4 * i]);
  // All at once: one turn after the other would leave a plane in which they all lie together.
  for (SolverBody& body : bodies_) {
    if (body.rebound_turn == Vec3::Zero()) continue;
    const Quat turn = exp_map(body.rebound_turn);
    body.rotation = turn * body.rotation;
    body.rotation.normalize();
    body.turn = turn * body.turn;
    body.turn.normalize();
  }
  bound_energy(bodies, loads, contacts);
}

}  // namespace tweenfall::step
