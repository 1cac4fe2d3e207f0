#pragma once

// Whether two curves of any type stay near each other over a stretch in which both are smooth.

#include <tweenfall/curves/curve.h>

#include <algorithm>
#include <cmath>

#include "rotation/rotation_distance.h"
#include "splines/control_points.h"

namespace tweenfall::questions {

/// How far apart two samples are, how fast that can change, and how fast that rate can change at this time.
struct Apart {
  double distance, rate, acceleration;
};

template <class T>
[[nodiscard]] Apart apart(const Sample<T>& a, const Sample<T>& b) noexcept {
  if constexpr (std::is_same_v<T, Quat>) {
    // The turn between them changes at the difference of their angular velocities, both in the same axes.
    const Quat turn = a.value * b.value.conjugate();
    const Vec3 carried = turn * b.rate, carried_acceleration = turn * b.acceleration;
    const Vec3 rate = a.rate - carried, acceleration = a.acceleration - carried_acceleration;
    return {rotations::rotation_distance(a.value, b.value), splines::length_of(rate),
            splines::length_of(acceleration) + splines::length_of(a.rate) * splines::length_of(b.rate)};
  } else if constexpr (std::is_same_v<T, Color>) {
    return {splines::length_of(Vec4(a.value.rgba - b.value.rgba)), splines::length_of(Vec4(a.rate - b.rate)),
            splines::length_of(Vec4(a.acceleration - b.acceleration))};
  } else {
    return {splines::length_of(T(a.value - b.value)), splines::length_of(T(a.rate - b.rate)),
            splines::length_of(T(a.acceleration - b.acceleration))};
  }
}

/// Bounded by value and rate in the middle, and twice the greatest difference of accelerations found. Where 2^-16 of
/// the stretch is still undecided, the answer is no.
template <class T>
[[nodiscard]] bool stays_near(const Curve<T>& a, const Curve<T>& b, double from, double to, double bound,
                              int depth = 0) {
  const double middle = from + 0.5 * (to - from), reach = 0.5 * (to - from);
  const Apart first = apart(a.sample(from, Side::out), b.sample(from, Side::out));
  const Apart here = apart(a.sample(middle), b.sample(middle));
  const Apart last = apart(a.sample(to, Side::in), b.sample(to, Side::in));
  if (!(first.distance <= bound) || !(here.distance <= bound) || !(last.distance <= bound)) return false;
  const double bend = 2 * std::max({first.acceleration, here.acceleration, last.acceleration});
  if (here.distance + reach * (here.rate + 0.5 * reach * bend) <= bound && depth > 0) return true;
  if (depth == 16 || !(from < middle && middle < to)) return false;
  return stays_near(a, b, from, middle, bound, depth + 1) && stays_near(a, b, middle, to, bound, depth + 1);
}

}  // namespace tweenfall::questions
