#pragma once

// The slopes for which cubics through given values have a continuous second derivative, in linear time.
// Source: de Boor, "A Practical Guide to Splines", chapter IV.

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "slopes/c2_slopes.h"

namespace tweenfall::slopes {

// The equation that ties the slope of a run's first key (or last, seen backwards) to its neighbor's.
struct EndRow {
  double diagonal = 1, coupling = 0;
  std::vector<double> right;
};

// `own` is the span beside the end key, `next` the one after that.
template <class Run>
EndRow end_row(const Run& p, const C2End& end, std::size_t own, std::size_t next, double sign) {
  EndRow row{1, 0, std::vector<double>(p.dimensions())};
  const double h = p.duration(own);
  if (end.kind == C2End::Kind::not_a_knot && own != next) {
    const double total = h + p.duration(next);
    const double h0 = h / total, h1 = p.duration(next) / total;
    row.diagonal = h1;
    row.coupling = 1;
    for (std::size_t c = 0; c < p.dimensions(); ++c)
      row.right[c] = (h0 + 2) * h1 * p.secant(own, c) + h0 * h0 * p.secant(next, c);
    return row;
  }
  if (end.kind == C2End::Kind::second) {
    row.diagonal = 2;
    row.coupling = 1;
  }
  for (std::size_t c = 0; c < p.dimensions(); ++c) {
    const double given = end.given.empty() ? 0 : end.given[c];
    row.right[c] = end.kind == C2End::Kind::second  ? 3 * p.secant(own, c) - sign * 0.5 * h * given
                   : end.kind == C2End::Kind::slope ? given
                                                    : p.secant(own, c);
  }
  return row;
}

// Thomas' algorithm on rows that are made on the fly: for very many keys, memory access takes most of the time.
template <class Run>
std::vector<double> solve_rows(const Run& p, const EndRow& first, const EndRow& last) {
  const std::size_t spans = p.spans(), d = p.dimensions();
  std::vector<double> slopes((spans + 1) * d);
  const auto ratios = std::make_unique_for_overwrite<double[]>(spans);
  double inverse = 1 / first.diagonal;
  ratios[0] = first.coupling * inverse;
  for (std::size_t c = 0; c < d; ++c) slopes[c] = first.right[c] * inverse;
  double before = p.duration(0);
  std::array<double, 4> secants_before{};
  for (std::size_t c = 0; c < d; ++c) secants_before[c] = p.secant(0, c);
  for (std::size_t k = 1; k < spans; ++k) {
    const double after = p.duration(k), total = before + after;
    const double h0 = before / total, h1 = after / total;
    inverse = 1 / (2 - h1 * ratios[k - 1]);
    ratios[k] = h0 * inverse;
    for (std::size_t c = 0; c < d; ++c) {
      const double secant = p.secant(k, c);
      const double right = 3 * (h1 * secants_before[c] + h0 * secant);
      slopes[k * d + c] = (right - h1 * slopes[(k - 1) * d + c]) * inverse;
      secants_before[c] = secant;
    }
    before = after;
  }
  const double pivot = last.diagonal - last.coupling * ratios[spans - 1];
  for (std::size_t c = 0; c < d; ++c)
    slopes[spans * d + c] = (last.right[c] - last.coupling * slopes[(spans - 1) * d + c]) / pivot;
  for (std::size_t k = spans; k-- > 0;)
    for (std::size_t c = 0; c < d; ++c) slopes[k * d + c] -= ratios[k] * slopes[(k + 1) * d + c];
  return slopes;
}

// Sets the slopes at both ends to those of the parabola through three values.
template <class Run>
void fit_parabola(const Run& p, C2End& start, C2End& end) {
  const double h0 = p.duration(0), h1 = p.duration(1);
  start = end = {C2End::Kind::slope, std::vector<double>(p.dimensions())};
  for (std::size_t c = 0; c < p.dimensions(); ++c) {
    const double change = p.secant(1, c) - p.secant(0, c);
    start.given[c] = p.secant(0, c) - h0 / (h0 + h1) * change;
    end.given[c] = p.secant(1, c) + h1 / (h0 + h1) * change;
  }
}

/// The slopes at the keys of a run, `dimensions` per key. With not-a-knot the first (last) two spans are one cubic;
/// where there are too few spans for that, the polynomial of least degree through the values.
/// @param p has `spans()`, `dimensions()` (4 at most), `duration(span)` and `secant(span, component)`
template <class Run>
[[nodiscard]] std::vector<double> c2_slopes(const Run& p, C2End start, C2End end) {
  const std::size_t last = p.spans() - 1, second = last > 0 ? 1 : 0;
  if (last == 1 && start.kind == C2End::Kind::not_a_knot && end.kind == C2End::Kind::not_a_knot)
    fit_parabola(p, start, end);
  return solve_rows(p, end_row(p, start, 0, second, 1), end_row(p, end, last, last - second, -1));
}

}  // namespace tweenfall::slopes
