#pragma once

// The position on a Bezier span at a given time: the inverse of the handles' own cubic in time.

#include <tweenfall/curves/span.h>

#include "math/polynomial.h"

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
