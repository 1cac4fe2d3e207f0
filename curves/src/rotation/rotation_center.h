#pragma once

// The rotation from which the weighted ways to others cancel, and how it moves with them.

#include <tweenfall/curves/rotation.h>

#include <Eigen/LU>

#include "math/jet.h"
#include "rotation/moving_rotation.h"

namespace tweenfall::rotations {

// From one rotation to another by the short way.
[[nodiscard]] inline MovingVector short_way(const MovingRotation& from, const MovingRotation& to) noexcept {
  MovingRotation between = quotient(from, to);
  if (between.value.w() < 0) between.value.coeffs() *= -1;
  return signed_log(between);
}

/// `get(i)` is rotation i as a Sample, `weight(i)` its weight as a Jet; weights sum to one.
///
/// With r_i the way to rotation i in the axes of the center, sum w_i r_i = 0. A small turn d of the center takes
/// J(-r_i)^-1 d off every way, from which Newton's method follows, and differentiating the sum twice gives the rates.
template <class Get, class Weight>
[[nodiscard]] Sample<Quat> rotation_center(std::size_t count, const Get& get, const Weight& weight) noexcept {
  const Vec3 rest(0, 0, 0);
  std::size_t heaviest = 0;
  for (std::size_t i = 1; i < count; ++i)
    if (weight(i).v > weight(heaviest).v) heaviest = i;
  MovingRotation center{get(heaviest).value, rest, rest};

  const auto left_over = [&](const Quat& q, Mat3& slope) {
    Vec3 sum = rest;
    slope.setZero();
    for (std::size_t i = 0; i < count; ++i) {
      const double w = weight(i).v;
      if (w == 0) continue;
      const Vec3 r = log_map(q.conjugate() * get(i).value);
      sum += w * r;
      slope += w * right_jacobian_inverse(-r);
    }
    return sum;
  };
  Mat3 slope;
  Vec3 sum = left_over(center.value, slope);
  for (int round = 0; round < 40 && !sum.isZero(0); ++round) {
    Vec3 step = slope.inverse() * sum;
    bool better = false;
    for (int halving = 0; halving < 8 && !better; ++halving, step /= 2) {
      Quat next = center.value * exp_map(step);
      next.coeffs() /= std::sqrt(next.coeffs().squaredNorm());
      Mat3 next_slope;
      const Vec3 next_sum = left_over(next, next_slope);
      if (!(next_sum.squaredNorm() < sum.squaredNorm())) continue;
      better = true;
      center.value = next;
      sum = next_sum;
      slope = next_slope;
    }
    if (!better) break;
  }

  const Mat3 inverse = slope.inverse();
  Vec3 pull = rest;
  for (std::size_t i = 0; i < count; ++i) {
    const math::Jet w = weight(i);
    const MovingVector r = short_way(center, inner(get(i)));
    pull += w.d * r.value + w.v * r.first;
  }
  center.velocity = inverse * pull;
  pull = rest;
  for (std::size_t i = 0; i < count; ++i) {
    const math::Jet w = weight(i);
    const MovingVector r = short_way(center, inner(get(i)));
    pull += w.dd * r.value + 2 * w.d * r.first + w.v * r.second;
  }
  center.acceleration = inverse * pull;
  return outer(center);
}

}  // namespace tweenfall::rotations
