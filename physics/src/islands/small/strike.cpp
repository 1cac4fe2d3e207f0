#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "contacts/meeting.h"
#include "step/solver.h"

/// Blows of two bodies at a time.

namespace tweenfall::step {

namespace {

/// Points nearer than this touch, m, and those that meet within this part of the step.
constexpr double touching = 1e-6, meets_now = 2e-6;
/// Blows at one instant; what still closes after them is solved with the rest of the step.
constexpr int most_blows = 400;
/// Passes over the points of one blow, and a change of velocity that no longer matters, relative to the greatest speed.
constexpr int passes_of_a_blow = 100;
constexpr double struck = 1e-15;
/// For blows of so little restitution, a change below this does not matter either.
constexpr double dull = 0.25, struck_dully = 1e-9;
/// Blows whose speeds differ by less than this, relatively, count as one.
constexpr double alike = 1e-9;
/// Rounding of an energy, relative.
constexpr double no_energy = 1e-14;

}  // namespace

double Solver::closing_speed(const SolvedContact& contact) const {
  const SolverBody &a = at(contact.a), &b = at(contact.b);
  double fastest = 0;
  for (int i = 0; i < contact.count; ++i) {
    const SolvedPoint& point = contact.points[static_cast<std::size_t>(i)];
    if (point.gap > touching_) continue;
    const double speed = contact.normal.dot(point_velocity(a, point.arm_a) - point_velocity(b, point.arm_b));
    fastest = std::max(fastest, speed);
  }
  return fastest;
}

/// One blow in each of these contacts at once.
void Solver::strike_at_once(std::span<const std::size_t> numbers) {
  const auto each_point = [&](const auto& see) {
    for (const std::size_t n : numbers) {
      SolvedContact& contact = contacts_[n];
      for (int i = 0; i < contact.count; ++i) {
        SolvedPoint& point = contact.points[static_cast<std::size_t>(i)];
        if (!(point.gap > touching_)) see(contact, point, rows_[4 * n + static_cast<std::size_t>(i)]);
      }
    }
  };
  double fastest = 0;
  each_point([&](const SolvedContact& contact, SolvedPoint& point, const PointRows&) {
    const double closing =
        contact.normal.dot(point_velocity(at(contact.a), point.arm_a) - point_velocity(at(contact.b), point.arm_b));
    fastest = std::max(fastest, closing);
    point.approach = std::max(point.approach, closing);
    point.rebound = contact.restitution * std::max(0.0, closing);
    point.normal_impulse = 0;
    point.friction_impulse = Vec3::Zero();
  });
  std::vector<SolverBody> before;
  for (const std::size_t n : numbers)
    for (const SolverBody* body : {&at(contacts_[n].a), &at(contacts_[n].b)}) {
      const auto is_it = [body](const SolverBody& other) { return other.index == body->index; };
      if (body->movable && std::none_of(before.begin(), before.end(), is_it)) before.push_back(*body);
    }
  const bool springs_back =
      std::any_of(numbers.begin(), numbers.end(), [this](std::size_t n) { return contacts_[n].restitution > dull; });
  const double enough = (springs_back ? struck : struck_dully) * fastest;
  for (int pass = 0; pass < passes_of_a_blow; ++pass) {
    double change = 0;
    each_point([&](SolvedContact& contact, SolvedPoint& point, const PointRows& rows) {
      SolverBody &a = at(contact.a), &b = at(contact.b);
      if (contact.friction > 0)
        change = std::max(change,
                          solve_friction(a, b, rows, point.friction_impulse, contact.friction * point.normal_impulse));
      change = std::max(change, solve_normal(a, b, rows, point.normal_impulse, point.rebound, contact.normal));
    });
    if (change <= enough) break;
  }
  // With friction, a rebound at the requested speed may have more energy than there was.
  double slope = 0, curvature = 0;
  for (const SolverBody& start : before) {
    const SolverBody& body = at(start.index);
    const double mass = 1 / body.inverse_mass;
    const Vec3 linear = body.linear - start.linear, angular = body.angular - start.angular;
    const Vec3 turning = body.inverse_inertia.inverse() * angular;
    slope += mass * start.linear.dot(linear) + start.angular.dot(turning);
    curvature += 0.5 * (mass * linear.squaredNorm() + angular.dot(turning));
  }
  const double share = slope + curvature > no_energy * curvature ? std::clamp(-slope / curvature, 0.0, 1.0) : 1;
  if (share < 1)
    for (const SolverBody& start : before) {
      SolverBody& body = at(start.index);
      body.linear = start.linear + share * (body.linear - start.linear);
      body.angular = start.angular + share * (body.angular - start.angular);
    }
  each_point([&](const SolvedContact&, SolvedPoint& point, const PointRows&) {
    point.total_normal += share * point.normal_impulse;
    point.total_friction += share * point.friction_impulse;
  });
}

const std::vector<Blow>& Solver::strike(std::vector<state::Body>& bodies, const std::vector<forces::Load>& loads,
                                        std::span<contacts::ContactConstraint* const> found, double dt) {
  gather(bodies, found, {}, dt);
  contacts_.clear();
  contacts_.reserve(found.size());
  for (contacts::ContactConstraint* contact : found) contacts_.emplace_back(*contact);
  rows_.resize(4 * contacts_.size());
  std::vector<double> trembles;
  trembles.reserve(contacts_.size());
  for (std::size_t n = 0; n < contacts_.size(); ++n) {
    const SolvedContact& contact = contacts_[n];
    trembles.push_back(contacts::closing_of(contact.normal, loads[contact.a], loads[contact.b], dt).tremble);
    const Tangents along = contact.friction > 0 ? tangents_of(contact.normal) : Tangents{};
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i)
      rows_[4 * n + i].prepare(at(contact.a), at(contact.b), contact.points[i], contact.normal,
                               contact.friction > 0 ? &along : nullptr);
  }
  touching_ = std::numeric_limits<double>::infinity();
  double fastest_of_all = 0;
  for (const SolvedContact& contact : contacts_) fastest_of_all = std::max(fastest_of_all, closing_speed(contact));
  touching_ = std::max(touching, meets_now * dt * fastest_of_all);
  std::vector<std::size_t> hardest;
  std::vector<double> speeds(contacts_.size());
  for (int blow = 0; blow < most_blows; ++blow) {
    double fastest = 0;
    for (std::size_t n = 0; n < contacts_.size(); ++n) {
      const double speed = closing_speed(contacts_[n]);
      speeds[n] = speed > trembles[n] ? speed : 0;
      fastest = std::max(fastest, speeds[n]);
    }
    if (fastest == 0) break;
    hardest.clear();
    for (std::size_t n = 0; n < contacts_.size(); ++n)
      if (speeds[n] >= (1 - alike) * fastest) hardest.push_back(n);
    strike_at_once(hardest);
  }
  blows_.clear();
  for (const SolvedContact& contact : contacts_) {
    Blow sum;
    sum.contact = contact.origin;
    for (int i = 0; i < contact.count; ++i) {
      const SolvedPoint& point = contact.points[static_cast<std::size_t>(i)];
      sum.normal += point.total_normal;
      sum.impulse += point.total_normal * contact.normal + point.total_friction;
      sum.approach = std::max(sum.approach, point.approach);
    }
    if (sum.normal == 0) continue;
    blows_.push_back(sum);
    // A rebound says nothing about the forces after it.
    if (contact.restitution > 0)
      for (contacts::PointConstraint& point : contact.origin->points) {
        point.kept_normal = 0;
        point.kept_friction = Vec3::Zero();
      }
  }
  for (const SolverBody& entry : bodies_) {
    if (!entry.movable) continue;
    state::Body& body = bodies[entry.index];
    body.twist = {entry.linear, entry.angular};
    body.follow_center(body.motion.pose.rotation);
  }
  return blows_;
}

}  // namespace tweenfall::step
