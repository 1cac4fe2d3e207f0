#include <algorithm>
#include <cmath>

#include "planar/contacts/contact_solver.h"

namespace tweenfall::planar::inner {

namespace {

/// Passes over all contacts that may rebound: a blow gets through a row of at least this many bodies.
constexpr int most_passes = 60;
/// Blows of two points of one contact that are nearer in time than this part of a sub-step count as one.
constexpr double at_once = 0.01;
/// A rebound must be faster than what gravity takes from it in this many sub-steps.
constexpr double trembles = 2;
constexpr double slowest = 1e-6;  // m/s

/// A body's part of the speed at a point.
double speed_of(const BodyRow& row, double normal_x, double normal_y, double turn) {
  return normal_x * row.x + normal_y * row.y + turn * row.turn;
}

}  // namespace

/// Between blows, bodies fly under gravity: when the gap closes is the root of a quadratic, and so is how fast.
ContactSolver::Arrival ContactSolver::arrival(const ContactBlock& block, int lane, int i, double h) const {
  const PointRow& point = block.point[i];
  const std::uint32_t a = block.a[lane] / row_length, b = block.b[lane] / row_length;
  const double normal_x = block.normal_x[lane], normal_y = block.normal_y[lane];
  const auto between = [&](const std::vector<BodyRow>& rows) {
    return speed_of(rows[b], normal_x, normal_y, point.turn_b[lane]) -
           speed_of(rows[a], normal_x, normal_y, point.turn_a[lane]);
  };
  const double start = -between(starts_), pull = (-between(velocities_) - start) / h;
  const double since = std::max(struck_at_[a], struck_at_[b]);
  const double gap = point.gap[lane] + between(displacements_) - since * (start + 0.5 * pull * since);
  const double closing = start + pull * since;
  Arrival arrival{since, closing};
  if (gap > 0) {
    const double square = closing * closing + 2 * pull * gap;
    if (!(square > 0)) return {};
    arrival.speed = std::sqrt(square);
    if (!(closing + arrival.speed > 0)) return {};
    arrival.when = since + 2 * gap / (closing + arrival.speed);
    if (!(arrival.when <= h)) return {};
  }
  return arrival.speed > std::max(slowest, trembles * pull * h * parts_) ? arrival : Arrival{};
}

/// Applies an impulse inside the sub-step, as if the bodies had started it so that they now fly away from the blow.
void ContactSolver::knock(const ContactBlock& block, int lane, double along, double across, int i, double when) {
  const PointRow& point = block.point[i];
  const double x = along * block.normal_x[lane] - across * block.normal_y[lane];
  const double y = along * block.normal_y[lane] + across * block.normal_x[lane];
  const auto give = [&](std::uint32_t row, double inverse_mass, double inverse_moment, double twist, double sign) {
    if (inverse_mass == 0) return;
    const std::uint32_t body = row / row_length;
    const BodyRow change{sign * inverse_mass * x, sign * inverse_mass * y, sign * inverse_moment * twist, 0};
    for (BodyRow* its : {&velocities_[body], &starts_[body]}) {
      its->x += change.x;
      its->y += change.y;
      its->turn += change.turn;
    }
    displacements_[body].x -= change.x * when;
    displacements_[body].y -= change.y * when;
    displacements_[body].turn -= change.turn * when;
    struck_at_[body] = when;
  };
  give(block.a[lane], block.inverse_mass_a[lane], block.inverse_moment_a[lane],
       along * point.turn_a[lane] + across * point.slip_a[lane], -1);
  give(block.b[lane], block.inverse_mass_b[lane], block.inverse_moment_b[lane],
       along * point.turn_b[lane] + across * point.slip_b[lane], 1);
}

/// Newton's law of restitution, from the speed at which the points meet; both points of a contact at once. Friction is
/// Coulomb's within the blow.
bool ContactSolver::strike(const Bouncy& bouncy, double h) {
  const ContactBlock& block = blocks_[bouncy.place / lane_count];
  const int lane = static_cast<int>(bouncy.place % lane_count);
  Arrival arrivals[2];
  for (int i = 0; i < bouncy.count; ++i) arrivals[i] = arrival(block, lane, i, h);
  Arrival &first = arrivals[0], &second = arrivals[1];
  if (first.speed == 0 && second.speed == 0) return false;
  if (first.speed > 0 && second.speed > 0 && std::abs(first.when - second.when) > at_once * h)
    (first.when < second.when ? second : first) = {};
  const double when = first.speed > 0 ? first.when : second.when;
  double impulse[2] = {0, 0};
  for (int i = 0; i < 2; ++i)
    if (arrivals[i].speed > 0) impulse[i] = (1 + bouncy.restitution) * arrivals[i].speed * block.point[i].mass[lane];
  if (first.speed > 0 && second.speed > 0) {
    const PointRow &one = block.point[0], &other = block.point[1];
    const double both = block.inverse_mass_a[lane] + block.inverse_mass_b[lane] +
                        block.inverse_moment_a[lane] * one.turn_a[lane] * other.turn_a[lane] +
                        block.inverse_moment_b[lane] * one.turn_b[lane] * other.turn_b[lane];
    // Each impulse alone, minus the effect of the other at its point.
    const double part = one.mass[lane] * both, other_part = other.mass[lane] * both, rest = 1 - part * other_part;
    if (rest > 1e-9) {
      const double alone = impulse[0], other_alone = impulse[1];
      impulse[0] = (alone - part * other_alone) / rest;
      impulse[1] = (other_alone - other_part * alone) / rest;
      if (impulse[0] < 0) {
        impulse[0] = 0;
        impulse[1] = other_alone;
      } else if (impulse[1] < 0) {
        impulse[0] = alone;
        impulse[1] = 0;
      }
    } else {
      impulse[0] *= 0.5;
      impulse[1] *= 0.5;
    }
  }
  Given& its = given[bouncy.active];
  for (int i = 0; i < 2; ++i) {
    if (impulse[i] == 0) continue;
    knock(block, lane, impulse[i], 0, i, when);
    its.normal[i] += impulse[i];
  }
  const double friction = block.friction[lane];
  for (int i = 0; i < 2 && friction > 0; ++i) {
    if (impulse[i] == 0) continue;
    const PointRow& point = block.point[i];
    const auto slip = [&](std::uint32_t row, double arm) {
      const BodyRow &start = starts_[row / row_length], &end = velocities_[row / row_length];
      const double share = when / h;
      return -block.normal_y[lane] * (start.x + (end.x - start.x) * share) +
             block.normal_x[lane] * (start.y + (end.y - start.y) * share) +
             arm * (start.turn + (end.turn - start.turn) * share);
    };
    const double speed = slip(block.b[lane], point.slip_b[lane]) - slip(block.a[lane], point.slip_a[lane]);
    const double limit = friction * impulse[i];
    const double across = std::clamp(-point.slip_mass[lane] * speed, -limit, limit);
    if (across == 0) continue;
    knock(block, lane, 0, across, i, when);
    its.sideways[i] += across;
  }
  return true;
}

void ContactSolver::strike(double h) {
  std::fill(struck_at_.begin(), struck_at_.end(), 0);
  for (int pass = 0; pass < most_passes; ++pass) {
    bool any = false;
    for (const Bouncy& bouncy : bouncy_) any = strike(bouncy, h) || any;
    if (!any) return;
  }
}

}  // namespace tweenfall::planar::inner
