#pragma once

/// Questions about a scalar curve, answered from its polynomials rather than from samples:
/// integral, range, extremes and the times at which it takes a value.

#include <tweenfall/curves/curve.h>

#include <vector>

namespace tweenfall {

/// Integral from `from` to `to`, U s; negative when to < from. Exact for polynomial spans.
/// Between the knots only: outside them, hold and linear are integrated in closed form.
[[nodiscard]] double integral(const Curve<double>& curve, double from, double to);

struct Range {
  double low, high;
};
/// Least and greatest value between `from` and `to`.
[[nodiscard]] Range range(const Curve<double>& curve, double from, double to);

/// Times inside the knots at which the rate passes through zero, in order; none on flat stretches.
[[nodiscard]] std::vector<double> extrema(const Curve<double>& curve);

/// All times from `from` to `to` at which the curve equals `level`, in order. Where it rests on
/// the level for a while, the stretch's two ends.
[[nodiscard]] std::vector<double> solve(const Curve<double>& curve, double level, double from, double to);

}  // namespace tweenfall
