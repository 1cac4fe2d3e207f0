#pragma once

// Derivatives of any order from a curve's polynomials, for tests that need more than two orders.

#include <tweenfall/curves/curve.h>

namespace tweenfall::test {

/// Derivative of a curve of plain polynomial spans between its first knot and its last.
inline double derivative_of_spans(const Curve<double>& curve, int order, double time, Side side) {
  const std::vector<Span<double>> spans = curve.spans();
  std::size_t i = 0;
  while (i + 1 < spans.size() && (spans[i + 1].start < time || (spans[i + 1].start == time && side == Side::out))) ++i;
  const Span<double>& span = spans[i];
  const double u = time == span.start + span.duration ? 1 : (time - span.start) / span.duration;
  double sum = 0;
  for (int k = span.degree; k >= order; --k) {
    double factor = span.coefficients[static_cast<std::size_t>(k)];
    for (int j = 0; j < order; ++j) factor *= (k - j) / span.duration;
    sum = sum * u + factor;
  }
  return sum;
}

}  // namespace tweenfall::test
