#pragma once

// The position on a Bezier span at a given time: the inverse of the handles' own cubic in time.

#include <tweenfall/curves/span.h>

#include "math/polynomial.h"

#include <cmath>
#include <type_traits>

namespace tweenfall::spans {

/// Warp with parameters {x1, x2}: the handles' times as shares of the span, such that time never runs
/// backwards (they may lie outside 0 to 1). Where the tangent is vertical the slope is limited to a million.
[[nodiscard]] Warp time_bezier_warp(double x1, double x2);

/// Whether a warp is one of these; its parameters then begin with x1 and x2.
[[nodiscard]] bool is_time_bezier(const Warp& warp) noexcept;

/// The handles' cubic in time, power basis: from 0 to 1 by way of x1 and x2.
[[nodiscard]] inline std::array<double, 4> time_cubic(double x1, double x2) noexcept {
  return {0, 3 * x1, 3 * x2 - 6 * x1, 1 + 3 * x1 - 3 * x2};
}

/// The least slope of time over the position on the handles; below it, it counts as this one.
inline constexpr double least_time_slope = 1e-6;

/// At an end where a handle has no length, the value rests over the position on the handles just as time does, and
/// still has a rate over time: the limit of the one over the other, by L'Hopital's rule. CSS's ease-in arrives so.
/// Where time rests longer than the value does, that limit is infinite: the rate is that of where time begins to count.
/// @param p  with derivatives by the position s, here and below; those by time, over the whole span, once this is done
/// @param c  its coefficients
/// @return   whether both rest; else nothing is changed
template <class V>
bool limit_where_time_rests(const Warp& warp, double s, const V* c, int degree, math::Polynomial<V>& p) noexcept {
  if (!is_time_bezier(warp)) return false;
  const auto size = [](const V& v) {
    if constexpr (std::is_same_v<V, double>)
      return std::abs(v);
    else
      return v.norm();
  };
  const std::array<double, 4> x = time_cubic(warp.parameters[0], warp.parameters[1]);
  const double slope = (3 * x[3] * s + 2 * x[2]) * s + x[1], second = 6 * x[3] * s + 2 * x[2], third = 6 * x[3];
  if (!(slope < least_time_slope)) return false;
  constexpr double some = 4 * least_time_slope;  // so near to the end both are as good as at rest
  constexpr double nearly = 0.1, rounding = 1e-9;
  const bool rests_on = degree == 3 && third != 0 && std::abs(second * second - 2 * third * slope) <= some;
  if (!rests_on && std::abs(second) > some && size(p.first) * std::abs(second) <= some * size(p.second) &&
      size(V(p.first * second - p.second * slope)) <=
          (nearly * size(p.first) + rounding * size(p.second)) * std::abs(second)) {
    p.first = p.second * (warp.width / second);
  } else if (rests_on && std::abs(second) <= some && size(p.first) <= some * size(c[3]) &&
             size(p.second) <= some * size(c[3])) {
    p.first = c[3] * (6 * warp.width / third);
  } else if (rests_on && (s < nearly || s > 1 - nearly) && size(p.first) <= nearly * size(p.second)) {
    const double begins = std::sqrt(2 * least_time_slope / std::abs(third)) / least_time_slope;
    p.first = p.second * ((s < nearly ? begins : -begins) * warp.width);
  } else {
    return false;
  }
  p.second = p.second * 0;  // it has none: the rate begins or ends as the square root of time does
  return true;
}

/// The same for the part of a span that its warp shows, in that part's own variable; the span's polynomial `c` is
/// replaced by its part likewise. Precondition: is_time_bezier(warp).
template <class V>
[[nodiscard]] std::array<double, 4> shown_time_cubic(const Warp& warp, V* c, int degree) noexcept {
  std::array<double, 4> x = time_cubic(warp.parameters[0], warp.parameters[1]);
  const double s0 = warp.at(0).s, s1 = warp.at(1).s;
  if (s0 == 0 && s1 == 1) return x;
  math::substitute(c, degree, s0, s1 - s0);
  math::substitute(x.data(), 3, s0, s1 - s0);
  const double width = x[1] + x[2] + x[3];
  return {0, x[1] / width, x[2] / width, x[3] / width};
}

}  // namespace tweenfall::spans
