#pragma once

// Bounds of polynomials over 0 to 1 from their Bezier control points: the polynomial stays in their convex hull.

#include <algorithm>
#include <cmath>
#include <vector>

#include "curve/components.h"

namespace tweenfall::splines {

template <class V>
[[nodiscard]] double length_of(const V& v) noexcept {
  if constexpr (std::is_same_v<V, double>)
    return std::abs(v);
  else
    return std::sqrt(v.squaredNorm());
}

/// From power basis to Bernstein's, in place.
template <class V>
void make_control_points(std::vector<V>& c) {
  const std::size_t n = c.size() - 1;
  // c[i] / binomial(n, i), then the table of sums.
  double binomial = 1;
  for (std::size_t i = 0; i <= n; ++i) {
    c[i] = c[i] / binomial;
    binomial = binomial * static_cast<double>(n - i) / static_cast<double>(i + 1);
  }
  for (std::size_t k = 1; k <= n; ++k)
    for (std::size_t i = n; i >= k; --i) c[i] = c[i] + c[i - 1];
}

/// The two halves of a polynomial given by control points; the first stays in `points`.
template <class V>
[[nodiscard]] std::vector<V> take_second_half(std::vector<V>& points) {
  const std::size_t n = points.size() - 1;
  std::vector<V> second(points.size());
  for (std::size_t k = 0; k <= n; ++k) {
    second[n - k] = points[n];
    for (std::size_t i = n; i > k; --i) points[i] = 0.5 * (points[i] + points[i - 1]);
  }
  return second;
}

/// Whether the polynomial with these control points is nowhere longer than `bound`. Where that cannot be
/// decided within 2^-20 of the interval, the answer is no.
template <class V>
[[nodiscard]] bool stays_within(std::vector<V> points, double bound, int depth = 0) {
  // Written so that NaN is not within.
  if (!(length_of(points.front()) <= bound) || !(length_of(points.back()) <= bound)) return false;
  if (std::all_of(points.begin(), points.end(), [bound](const V& p) { return length_of(p) <= bound; })) return true;
  if (depth == 20) return false;
  const std::vector<V> second = take_second_half(points);
  return stays_within(points, bound, depth + 1) && stays_within(second, bound, depth + 1);
}

}  // namespace tweenfall::splines
