#pragma once

// The rotation from which the weighted rotation vectors to others sum to zero, and how it moves with them.

#include <tweenfall/curves/rotation.h>

#include <Eigen/LU>

#include "math/cross_matrix.h"
#include "math/jet.h"
#include "rotation/moving_rotation.h"
#include "rotation/rotation_parts.h"

namespace tweenfall::rotations {

// The rotation vector from one rotation to another, the short way.
[[nodiscard]] inline MovingVector short_way(const MovingRotation& from, const MovingRotation& to) noexcept {
  MovingRotation between = quotient(from, to);
  if (between.value.w() < 0) between.value.coeffs() *= -1;
  return signed_log(between);
}

/// The sum of the weighted rotation vectors from a rotation to others, and how a small turn of it reduces that.
struct Balance {
  Vec3 sum{0, 0, 0};
  Mat3 slope = Mat3::Zero();

  template <class Get, class Weight>
  Balance(const Quat& q, std::size_t count, const Get& get, const Weight& weight) noexcept {
    const Quat back = q.conjugate();
    double even = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double w = weight(i).v;
      if (w == 0) continue;
      const LogParts way(back * get(i).value);
      sum += w * way.r;
      // J(-r)^-1 = 1 - [r]/2 + c [r]^2, and [r]^2 = r r^T - |r|^2
      const Vec3 bent = (w * way.c) * way.r;
      for (int k = 0; k < 3; ++k) slope.col(k) += way.r[k] * bent;
      even += w - bent.dot(way.r);
    }
    slope.diagonal().array() += even;
    slope -= 0.5 * math::cross_matrix(sum);
  }
};

/// A start near the center if all lie near each other: the mean of the quaternions, with signs aligned to the heaviest.
template <class Get, class Weight>
[[nodiscard]] Quat center_guess(std::size_t count, const Get& get, const Weight& weight) noexcept {
  std::size_t heaviest = 0;
  for (std::size_t i = 1; i < count; ++i)
    if (weight(i).v > weight(heaviest).v) heaviest = i;
  const Quat first = get(heaviest).value;
  Vec4 sum = Vec4::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const double w = weight(i).v;
    if (w < 0) return first;
    const Quat q = get(i).value;
    sum += (q.dot(first) < 0 ? -w : w) * q.coeffs();
  }
  const double length = std::sqrt(sum.squaredNorm());
  if (!(length > 0.5)) return first;
  return Quat(sum / length);
}

/// A center, how it turns, and the inverse of the slope of its balance.
struct TurningCenter {
  MovingRotation moving;
  Mat3 inverse;
};

/// `get(i)` is rotation i as a Sample, `weight(i)` its weight as a Jet; weights sum to one. The acceleration is left
/// out.
///
/// With r_i the rotation vector to rotation i in the axes of the center, sum w_i r_i = 0. A small turn d of the center
/// subtracts J(-r_i)^-1 d from each, which gives Newton's method, and differentiating the sum gives the rate.
template <class Get, class Weight>
[[nodiscard]] TurningCenter turning_center(std::size_t count, const Get& get, const Weight& weight) noexcept {
  Quat center = center_guess(count, get, weight);
  const auto turned = [](const Quat& q, const Vec3& step) {
    Quat next = q * exp_map(step);
    next.coeffs() /= std::sqrt(next.coeffs().squaredNorm());
    return next;
  };
  Balance balance(center, count, get, weight);
  for (int round = 0; round < 40; ++round) {
    Vec3 step = balance.slope.inverse() * balance.sum;
    const double square = step.squaredNorm();
    if (!(square > 1e-32)) break;
    if (square < 1e-16) {  // the error after one more step of Newton's method is the square of it
      center = turned(center, step);
      balance = Balance(center, count, get, weight);
      break;
    }
    bool better = false;
    for (int halving = 0; halving < 8 && !better; ++halving, step /= 2) {
      const Quat next = turned(center, step);
      const Balance there(next, count, get, weight);
      if (!(there.sum.squaredNorm() < balance.sum.squaredNorm())) continue;
      better = true;
      center = next;
      balance = there;
    }
    if (!better) break;
  }

  const Vec3 rest(0, 0, 0);
  TurningCenter result{{center, rest, rest}, balance.slope.inverse()};
  Vec3 pull = rest;
  const Quat back = center.conjugate();
  for (std::size_t i = 0; i < count; ++i) {
    const math::Jet w = weight(i);
    const Sample<Quat> other = get(i);
    const LogParts way(back * other.value);
    pull += w.d * way.r + w.v * way.right_inverse(other.value.conjugate() * other.rate);
  }
  result.moving.velocity = result.inverse * pull;
  return result;
}

/// The same with the acceleration, by differentiating the sum twice.
template <class Get, class Weight>
[[nodiscard]] Sample<Quat> rotation_center(std::size_t count, const Get& get, const Weight& weight) noexcept {
  TurningCenter center = turning_center(count, get, weight);
  Vec3 pull(0, 0, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const math::Jet w = weight(i);
    const MovingVector r = short_way(center.moving, inner(get(i)));
    pull += w.dd * r.value + 2 * w.d * r.first + w.v * r.second;
  }
  center.moving.acceleration = center.inverse * pull;
  return outer(center.moving);
}

}  // namespace tweenfall::rotations
