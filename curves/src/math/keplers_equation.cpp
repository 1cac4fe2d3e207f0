#include "math/keplers_equation.h"

#include <tweenfall/curves/elementary.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tweenfall::math {
namespace {

// (x - sin x) for sign -1, (sinh x - x) for +1, from the series where the difference would lose digits.
double excess(double x, double sign) noexcept {
  if (std::abs(x) > 1) return sign < 0 ? x - elementary::sin(x) : elementary::sinh(x) - x;
  const double z = sign * x * x;
  double sum = 1;
  for (int k = 18; k >= 4; k -= 2) sum = 1 + z / (k * (k + 1)) * sum;
  return x * x * x / 6 * sum;
}

// Newton's method from a start at or above the root of an increasing convex function, until it stops descending.
// `step` is the function over its slope.
template <class Step>
double descended(double x, const Step& step) noexcept {
  for (int i = 0; i < 200; ++i) {
    const double next = x - step(x);
    if (!(next < x)) break;
    x = next;
  }
  return x;
}

}  // namespace
}  // namespace tweenfall::math

namespace tweenfall::math {

double eccentric_anomaly(double mean, double eccentricity) noexcept {
  const double e = eccentricity, m = std::abs(mean);
  // Each bound lies above the root: sin E <= 1, sin E <= E, and E - sin E >= E^3 / pi^2 up to pi. Up to pi the function
  // is convex, and its root lies there.
  using std::numbers::pi;
  constexpr double pi_squared = 0x1.3bd3cc9be45dep+3;
  const double above = std::min({pi, m + e, m / (1 - e), elementary::cbrt(pi_squared * m / std::max(e, 0.1))});
  const double anomaly = math::descended(above, [e, m](double x) {
    const double half = elementary::sin(0.5 * x);
    return ((1 - e) * x + e * math::excess(x, -1) - m) / ((1 - e) + 2 * e * half * half);
  });
  return std::copysign(anomaly, mean);
}

double hyperbolic_anomaly(double mean, double eccentricity) noexcept {
  const double e = eccentricity, m = std::abs(mean);
  // Each bound lies above the root: e sinh H - H >= (e - 1) sinh H, >= e H^3 / 6, and from H = 2.2 on >= e sinh(H) / 2.
  const double above = std::min(
      {elementary::asinh(m / (e - 1)), elementary::cbrt(6 * m / e), std::max(2.2, elementary::asinh(2 * m / e))});
  const double anomaly = math::descended(above, [e, m](double x) {
    const double half = elementary::sinh(0.5 * x);
    return ((e - 1) * x + e * math::excess(x, 1) - m) / ((e - 1) + 2 * e * half * half);
  });
  return std::copysign(anomaly, mean);
}

}  // namespace tweenfall::math
