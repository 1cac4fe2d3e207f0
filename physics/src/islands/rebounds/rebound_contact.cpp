#include "islands/rebounds/rebound_contact.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::blocks {

void ReboundContact::take(const ContactBlocks& contacts, std::uint32_t index, const std::vector<IslandBody>& bodies) {
  lane_ = index;
  const std::size_t i = index / lane_count;
  const int lane = static_cast<int>(index % lane_count);
  const contacts::ContactConstraint& contact = *contacts.origins[i][static_cast<std::size_t>(lane)];
  const ContactBlock& block = contacts.blocks[i];
  a_ = block.a[lane];
  b_ = block.b[lane];
  inverse_mass_a_ = block.inverse_mass_a[lane];
  inverse_mass_b_ = block.inverse_mass_b[lane];
  normal_ = lane_of(block.normal, lane);
  coefficient_ = block.coefficient[lane];
  // For most contacts, only the lane is read.
  grips_ = block.hard[lane] != 0 && contact.impact;
  body_a_ = &bodies[a_];
  body_b_ = &bodies[b_];
  inverse_moment_a_ = body_a_->inverse_moment;
  inverse_moment_b_ = body_b_->inverse_moment;
  tremble_ = contacts.meetings[i].tremble[lane];
  count_ = static_cast<std::size_t>(contact.count);
  central_ = block.central();
  isotropic_ = body_a_->isotropic && body_b_->isotropic;
  frictions_ = central_ ? 1 : block.frictions > 0 ? count_ : 0;
  tangent1_ = lane_of(block.tangent1, lane);
  tangent2_ = lane_of(block.tangent2, lane);
  for (std::size_t k = 0; k < count_; ++k) {
    const PointRow& row = contacts.points[block.point + k];
    const double impulse = row.impulse[lane];
    points_[k] = {row.mass[lane],           row.gap[lane], impulse, impulse, 0, lane_of(row.turn_a, lane),
                  lane_of(row.turn_b, lane)};
  }
  for (std::size_t k = 0; k < frictions_; ++k) {
    const FrictionRow& row = contacts.frictions[block.friction + k];
    rows_[k] = {row.inverse11[lane],
                row.inverse12[lane],
                row.inverse22[lane],
                row.firm[lane],
                row.first[lane],
                row.second[lane],
                row.first[lane],
                row.second[lane],
                lane_of(row.first_a, lane),
                lane_of(row.first_b, lane),
                lane_of(row.second_a, lane),
                lane_of(row.second_b, lane)};
    if (!block.drifts) continue;
    rows_[k].drift1 = contacts.drifts[block.friction + k].first[lane];
    rows_[k].drift2 = contacts.drifts[block.friction + k].second[lane];
  }
}

void ReboundContact::push(BodyLanes& a, BodyLanes& b, const Vec3& impulse) const {
  if (body_a_->movable) add(a.linear, -inverse_mass_a_ * impulse);
  if (body_b_->movable) add(b.linear, inverse_mass_b_ * impulse);
}

void ReboundContact::turn(BodyLanes& a, BodyLanes& b, const Vec3& turn_a, const Vec3& turn_b) const {
  if (body_a_->movable)
    add(a.angular, -(isotropic_ ? Vec3(inverse_moment_a_ * turn_a) : Vec3(body_a_->inverse_inertia * turn_a)));
  if (body_b_->movable)
    add(b.angular, isotropic_ ? Vec3(inverse_moment_b_ * turn_b) : Vec3(body_b_->inverse_inertia * turn_b));
}

double ReboundContact::solve_friction(Friction& row, double limit, BodyLanes& a, BodyLanes& b) const {
  const Vec3 slip = linear_of(b) - linear_of(a);
  const Vec3 angular_a = angular_of(a), angular_b = angular_of(b);
  const double slip1 = tangent1_.dot(slip) + row.first_b.dot(angular_b) - row.first_a.dot(angular_a) + row.drift1;
  const double slip2 = tangent2_.dot(slip) + row.second_b.dot(angular_b) - row.second_a.dot(angular_a) + row.drift2;
  double next1 = row.first - (row.inverse11 * slip1 + row.inverse12 * slip2);
  double next2 = row.second - (row.inverse12 * slip1 + row.inverse22 * slip2);
  if (next1 * next1 + next2 * next2 > limit * limit) {
    next1 = row.first - row.firm * slip1;
    next2 = row.second - row.firm * slip2;
    const double length = std::sqrt(next1 * next1 + next2 * next2);
    if (length > limit) {
      next1 *= limit / length;
      next2 *= limit / length;
    }
  }
  const double change1 = next1 - row.first, change2 = next2 - row.second;
  row.first = next1;
  row.second = next2;
  push(a, b, change1 * tangent1_ + change2 * tangent2_);
  turn(a, b, change1 * row.first_a + change2 * row.second_a, change1 * row.first_b + change2 * row.second_b);
  return row.firm > 0 ? std::max(std::abs(change1), std::abs(change2)) / row.firm : 0;
}

double ReboundContact::solve(std::vector<BodyLanes>& velocities) {
  BodyLanes &a = velocities[a_], &b = velocities[b_];
  double change = 0;
  if (grips_) {
    double pressing = 0;
    for (std::size_t k = 0; k < count_; ++k) pressing += points_[k].impulse;
    for (std::size_t k = 0; k < frictions_; ++k)
      change =
          std::max(change, solve_friction(rows_[k], coefficient_ * (central_ ? pressing : points_[k].impulse), a, b));
  }
  for (std::size_t k = 0; k < count_; ++k) {
    Point& point = points_[k];
    if (point.impulse == 0 && point.gap > 0) continue;
    const double next = std::max(0.0, point.impulse - point.mass * (speed(k, velocities) - point.wanted));
    const double pushed = next - point.impulse;
    if (pushed == 0) continue;
    point.impulse = next;
    push(a, b, pushed * normal_);
    turn(a, b, pushed * point.turn_a, pushed * point.turn_b);
    change = std::max(change, std::abs(pushed) / point.mass);
  }
  return change;
}

double ReboundContact::speed(std::size_t i, const std::vector<BodyLanes>& velocities) const {
  const BodyLanes &a = velocities[a_], &b = velocities[b_];
  const double along = normal_.dot(linear_of(b) - linear_of(a));
  return along + points_[i].turn_b.dot(angular_of(b)) - points_[i].turn_a.dot(angular_of(a));
}

double ReboundContact::work(const BodyLanes& will, bool a_moves) const {
  const Vec3 linear = linear_of(will), angular = angular_of(will);
  double sum = 0;
  for (std::size_t k = 0; k < count_; ++k)
    sum += given(k) * (normal_.dot(linear) + (a_moves ? points_[k].turn_b : points_[k].turn_a).dot(angular));
  for (std::size_t k = 0; k < frictions_; ++k) {
    const Friction& row = rows_[k];
    const Vec3 &first = a_moves ? row.first_b : row.first_a, &second = a_moves ? row.second_b : row.second_a;
    sum += (row.first - row.first_before) * (tangent1_.dot(linear) + first.dot(angular)) +
           (row.second - row.second_before) * (tangent2_.dot(linear) + second.dot(angular));
  }
  return a_moves ? -sum : sum;
}

void ReboundContact::take_back(double share) {
  const auto back = [share](double& value, double before) { value = before + share * (value - before); };
  for (std::size_t k = 0; k < count_; ++k) back(points_[k].impulse, points_[k].before);
  for (std::size_t k = 0; k < frictions_; ++k) {
    back(rows_[k].first, rows_[k].first_before);
    back(rows_[k].second, rows_[k].second_before);
  }
}

void ReboundContact::put_back(ContactBlocks& contacts) const {
  const std::size_t i = lane_ / lane_count;
  const int lane = static_cast<int>(lane_ % lane_count);
  const ContactBlock& block = contacts.blocks[i];
  for (std::size_t k = 0; k < count_; ++k) contacts.points[block.point + k].total[lane] += given(k);
  for (std::size_t k = 0; k < frictions_; ++k) {
    FrictionRow& row = contacts.frictions[block.friction + k];
    row.total_first[lane] += rows_[k].first - rows_[k].first_before;
    row.total_second[lane] += rows_[k].second - rows_[k].second_before;
  }
}

}  // namespace tweenfall::blocks
