#pragma once

// A scalar curve between two times, as parts that are each one polynomial, a straight line, or a formula.

#include <tweenfall/curves/curve.h>

#include <vector>

namespace tweenfall {

struct CurvePart {
  double from, to;  ///< s, from < to
  /// Power basis in the position 0 to 1 from `from` to `to`; empty where only sampling answers.
  std::vector<double> coefficients;
};

/// In order, without gaps, from `from` to `to`.
[[nodiscard]] std::vector<CurvePart> curve_parts(const Curve<double>& curve, double from, double to);

}  // namespace tweenfall
