#include "islands/rebounds/rebound_ball.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::blocks {

void ReboundBall::take(const ContactBlocks& contacts, std::uint32_t index) {
  lane_ = index;
  const std::size_t i = index / lane_count - contacts.blocks.size();
  const int lane = static_cast<int>(index % lane_count);
  const BallBlock& block = contacts.balls[i];
  a_ = block.a[lane];
  b_ = block.b[lane];
  inverse_mass_a_ = block.inverse_mass_a[lane];
  inverse_mass_b_ = block.inverse_mass_b[lane];
  normal_ = lane_of(block.normal, lane);
  mass_ = block.mass[lane];
  gap_ = block.gap[lane];
  impulse_ = before_ = block.impulse[lane];
  wanted_ = 0;
  tremble_ = contacts.ball_meetings[i].tremble[lane];
  friction_ = friction_before_ = lane_of(block.friction, lane);
  // For most contacts, only the lane is read.
  grips_ = block.hard[lane] != 0 && contacts.ball_origins[i][static_cast<std::size_t>(lane)]->impact;
  if (!grips_) return;
  coefficient_ = block.coefficient[lane];
  arm_a_ = block.arm_a[lane];
  arm_b_ = block.arm_b[lane];
  spin_a_ = block.spin_a[lane];
  spin_b_ = block.spin_b[lane];
  slip_mass_ = block.slip_mass[lane];
}

double ReboundBall::solve_friction(BodyLanes& a, BodyLanes& b) {
  const Vec3 relative = linear_of(b) - linear_of(a);
  const Vec3 slip =
      relative - normal_.dot(relative) * normal_ - Vec3(arm_a_ * angular_of(a) + arm_b_ * angular_of(b)).cross(normal_);
  const double limit = coefficient_ * impulse_;
  Vec3 next = friction_ - slip_mass_ * slip;
  const double length = next.norm();
  if (length > limit) next *= limit / length;
  const Vec3 change = next - friction_;
  friction_ = next;
  push(a, b, change);
  const Vec3 turning = normal_.cross(change);
  if (inverse_mass_a_ > 0) add(a.angular, -spin_a_ * turning);
  if (inverse_mass_b_ > 0) add(b.angular, -spin_b_ * turning);
  return change.norm() / slip_mass_;
}

double ReboundBall::solve(std::vector<BodyLanes>& velocities) {
  BodyLanes &a = velocities[a_], &b = velocities[b_];
  const double change = grips_ ? solve_friction(a, b) : 0;
  if (impulse_ == 0 && gap_ > 0) return change;
  const double next = std::max(0.0, impulse_ - mass_ * (speed(0, velocities) - wanted_));
  const double pushed = next - impulse_;
  if (pushed == 0) return change;
  impulse_ = next;
  push(a, b, pushed * normal_);
  return std::max(change, std::abs(pushed) / mass_);
}

void ReboundBall::take_back(double share) {
  impulse_ = before_ + share * (impulse_ - before_);
  friction_ = friction_before_ + share * (friction_ - friction_before_);
}

void ReboundBall::put_back(ContactBlocks& contacts) const {
  const int lane = static_cast<int>(lane_ % lane_count);
  BallBlock& block = contacts.balls[lane_ / lane_count - contacts.blocks.size()];
  block.total[lane] += given(0);
  const Vec3 dragged = friction_ - friction_before_;
  block.total_friction.x[lane] += dragged.x();
  block.total_friction.y[lane] += dragged.y();
  block.total_friction.z[lane] += dragged.z();
}

}  // namespace tweenfall::blocks
