#include <tweenfall/curves/calculus.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "curve/spans_between.h"
#include "math/bracketing.h"
#include "math/polynomial_roots.h"
#include "questions/curve_pieces.h"

namespace tweenfall::questions {
namespace {

using Piece = CurvePiece<double>;

// A time found on a quintic, moved to where `f` of the curve itself changes sign nearby.
template <class F>
double refined(const Piece& piece, double time, const F& f) {
  const double reach = 1e-3 * (piece.to - piece.from);
  const double low = std::max(piece.from, time - reach), high = std::min(piece.to, time + reach);
  const double a = f(low), b = f(high);
  return (a < 0 && b > 0) || (a > 0 && b < 0) ? math::crossing(f, low, high) : time;
}

// Positions within the piece, ends left out, at which the rate vanishes.
std::vector<double> stationary(const Piece& piece) {
  std::vector<double> result =
      math::polynomial_roots(math::polynomial_derivative(component_polynomial(piece, 0)), 0, 1);
  std::erase_if(result, [](double s) { return s <= 0 || s >= 1; });
  return result;
}

double sign_of(double v) {
  return v > 0 ? 1 : v < 0 ? -1 : 0;
}

}  // namespace
}  // namespace tweenfall::questions

namespace tweenfall {

Range range(const Curve<double>& curve, double from, double to) {
  if (to < from) std::swap(from, to);
  spans::check_times(from, to);
  const double first = curve.value(from);
  Range result{first, first};
  const auto include = [&result](double v) {
    result.low = std::min(result.low, v);
    result.high = std::max(result.high, v);
  };
  for (const questions::Piece& piece : questions::curve_pieces(curve, from, to)) {
    include(curve.value(piece.from, Side::out));
    include(curve.value(piece.to, Side::in));
    for (const double s : questions::stationary(piece)) include(curve.value(piece.time_at(s)));
  }
  return result;
}

std::vector<double> extrema(const Curve<double>& curve) {
  std::vector<double> result;
  if (!(curve.duration() > 0)) return result;
  double before = 0;  // sign of the rate just passed
  for (const questions::Piece& piece : questions::curve_pieces(curve, curve.start(), curve.end())) {
    const std::vector<double> slope = math::polynomial_derivative(questions::component_polynomial(piece, 0));
    std::vector<double> marks = {0};
    for (const double s : questions::stationary(piece)) marks.push_back(s);
    marks.push_back(1);
    for (std::size_t i = 0; i + 1 < marks.size(); ++i) {
      const double sign = questions::sign_of(math::polynomial_value(slope, 0.5 * (marks[i] + marks[i + 1])));
      // A stretch at rest has no extreme, nor has what follows it.
      if (before * sign < 0) {
        const double time = piece.time_at(marks[i]);
        result.push_back(piece.exact() ? time
                                       : questions::refined(piece, time, [&](double t) { return curve.rate(t); }));
      }
      before = sign;
    }
  }
  return result;
}

std::vector<double> solve(const Curve<double>& curve, double level, double from, double to) {
  if (to < from) std::swap(from, to);
  spans::check_times(from, to);
  std::vector<double> result;
  const auto add = [&result, from, to](double t) {
    const double same = 1e-12 * (to - from);
    if (result.empty() || t - result.back() > same) result.push_back(t);
  };
  if (from == to && curve.value(from) == level) add(from);
  for (const questions::Piece& piece : questions::curve_pieces(curve, from, to)) {
    std::vector<double> c = questions::component_polynomial(piece, 0);
    c[0] -= level;
    if (std::all_of(c.begin(), c.end(), [](double v) { return v == 0; })) {
      // The ends of a stretch at rest; one that continues over a knot is not cut there.
      const bool goes_on = result.size() > 1 && result.back() == piece.from &&
                           curve.value(0.5 * (result[result.size() - 2] + piece.from)) == level;
      if (goes_on)
        result.back() = piece.to;
      else {
        add(piece.from);
        add(piece.to);
      }
      continue;
    }
    for (const double s : math::polynomial_roots(c, 0, 1)) {
      const double time = piece.time_at(s);
      add(piece.exact() ? time : questions::refined(piece, time, [&](double t) { return curve.value(t) - level; }));
    }
  }
  return result;
}

std::vector<double> roots(const Curve<double>& curve) {
  return solve(curve, 0, curve.start(), curve.end());
}

}  // namespace tweenfall
