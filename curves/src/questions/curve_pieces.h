#pragma once

// A curve between two times as polynomials, whatever it is made of: the basis of every query about its shape.

#include <tweenfall/curves/curve.h>

#include <array>
#include <vector>

#include "curve/curve_data.h"
#include "splines/control_points.h"

namespace tweenfall::questions {

/// value = sum c[i] s^i for s from 0 to 1, at the time from + (to - from) x(s): x(s) = s, or the cubic of weighted
/// handles. Spans that are neither (eases, formulas) are replaced by quintics with the curve's own value, rate and
/// acceleration at their ends, cut until they agree with it within 1e-12 of its size where checked, or as far as the
/// rounding of time allows.
template <class V>
struct CurvePiece {
  double from = 0, to = 1;  ///< s, from < to
  int degree = 0;
  std::array<V, max_degree + 1> c;
  bool timed = false;
  std::array<double, 4> x{0, 1, 0, 0};
  double error = 0;  ///< bound on the distance from the curve itself, U; 0 for all but quintics

  [[nodiscard]] double time_at(double s) const noexcept {
    if (s <= 0) return from;
    if (s >= 1) return to;
    const double u = timed ? ((x[3] * s + x[2]) * s + x[1]) * s : s;
    const double time = from + u * (to - from);
    return time < from ? from : time > to ? to : time;
  }
  [[nodiscard]] bool exact() const noexcept { return error == 0; }
  /// The rounding error of arithmetic with numbers of this size, plus `error`.
  [[nodiscard]] double rounding() const noexcept {
    double size = 0;
    for (int i = 0; i <= degree; ++i) size += splines::length_of(c[static_cast<std::size_t>(i)]);
    return 1e-14 * size + 4 * error;
  }
  /// The position at a time: the inverse of `time_at`.
  [[nodiscard]] double position_at(double time) const noexcept;
};

/// The pieces from `from` to `to`, in order and without gaps; empty where to <= from. Colors become their linear parts.
template <class T>
[[nodiscard]] std::vector<CurvePiece<typename spans::Stored<T>::type>> curve_pieces(const Curve<T>& curve, double from,
                                                                                    double to);

/// A piece with its own cubic in time as quintics in time, as for an ease.
template <class V>
[[nodiscard]] std::vector<CurvePiece<V>> as_quintics(const CurvePiece<V>& piece);

/// Coefficients of one component, degree + 1 of them.
template <class V>
[[nodiscard]] std::vector<double> component_polynomial(const CurvePiece<V>& piece, int component_index) {
  std::vector<double> result;
  for (int i = 0; i <= piece.degree; ++i)
    result.push_back(spans::component(piece.c[static_cast<std::size_t>(i)], component_index));
  return result;
}

}  // namespace tweenfall::questions
