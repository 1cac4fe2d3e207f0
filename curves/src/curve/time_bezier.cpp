#include "curve/time_bezier.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::spans {
namespace {

// Root of x(s) = u by Newton's method, safeguarded by bisection inside a bracket.
Warp::Result inverse_warp(double u, const std::array<double, 4>& parameters) noexcept {
  const double a = 3 * parameters[0];
  const double b = 3 * parameters[1] - 6 * parameters[0];
  const double c = 1 + 3 * parameters[0] - 3 * parameters[1];
  double s = u;
  if (u > 0 && u < 1) {
    double low = 0, high = 1;
    for (int i = 0; i < 80; ++i) {
      const double error = ((c * s + b) * s + a) * s - u;
      if (error == 0) break;
      (error < 0 ? low : high) = s;
      const double slope = (3 * c * s + 2 * b) * s + a;
      double next = s - error / slope;
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      if (next == s) break;
      const bool settled = std::abs(next - s) <= 1e-16;
      s = next;
      if (settled) break;
    }
  }
  const double slope = std::max((3 * c * s + 2 * b) * s + a, least_time_slope);
  const double second = 6 * c * s + 2 * b;
  return {s, 1 / slope, slope > least_time_slope ? -second / (slope * slope * slope) : 0};
}

}  // namespace
}  // namespace tweenfall::spans

namespace tweenfall::spans {

Warp time_bezier_warp(double x1, double x2) {
  return {&spans::inverse_warp, {x1, x2, 0, 0}};
}

bool is_time_bezier(const Warp& warp) noexcept {
  return warp.function == &spans::inverse_warp;
}

}  // namespace tweenfall::spans
