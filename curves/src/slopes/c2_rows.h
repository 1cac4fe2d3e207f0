#pragma once

// The slopes for which cubics through given values have a continuous second derivative, in linear time.
// Source: de Boor, "A Practical Guide to Splines", chapter IV.

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "curve/components.h"
#include "slopes/c2_slopes.h"

namespace tweenfall::slopes {

/// The values of a curve at its knots, in the form that `c2_slopes` takes.
template <class T>
struct ValueRun {
  std::span<const double> times;
  std::span<const T> values;

  [[nodiscard]] std::size_t spans() const noexcept { return times.size() - 1; }
  [[nodiscard]] static std::size_t dimensions() noexcept { return static_cast<std::size_t>(spans::dimensions<T>); }
  [[nodiscard]] double duration(std::size_t i) const noexcept { return times[i + 1] - times[i]; }
  [[nodiscard]] double secant(std::size_t i, std::size_t c) const noexcept {
    const int component = static_cast<int>(c);
    return (spans::component(values[i + 1], component) - spans::component(values[i], component)) / duration(i);
  }
};

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

// Thomas' algorithm from one end of a run toward its middle: m[k] is `slope` less `ratio` times the next unknown. Rows
// are made on the fly: for very many keys, memory access takes most of the time.
template <class Run>
struct Elimination {
  const Run& p;
  double ratio;
  std::array<double, 4> slope{}, secant{};  // the secant of the span behind
  double duration;                          // of that span

  Elimination(const Run& run, const EndRow& end, std::size_t own)
      : p(run), ratio(end.coupling / end.diagonal), duration(run.duration(own)) {
    for (std::size_t c = 0; c < p.dimensions(); ++c) {
      slope[c] = end.right[c] / end.diagonal;
      secant[c] = p.secant(own, c);
    }
  }

  // The row of the key between the span behind and the one ahead, divided by the duration of both: `ahead` of it times
  // the unknown behind, 2 m[k], and `behind` of it times the next unknown are 3 (ahead d_behind + behind d_ahead).
  void pass(std::size_t span_ahead) noexcept {
    const double next = p.duration(span_ahead), whole = 1 / (duration + next);
    const double ahead = next * whole, behind = duration * whole, inverse = 1 / (2 - ahead * ratio);
    for (std::size_t c = 0; c < p.dimensions(); ++c) {
      const double d = p.secant(span_ahead, c);
      slope[c] = (3 * (ahead * secant[c] + behind * d) - ahead * slope[c]) * inverse;
      secant[c] = d;
    }
    ratio = behind * inverse;
    duration = next;
  }
};

// Eliminates from both ends at once: each row waits for the one before, so that two rows take hardly longer than one.
// Source: Dongarra, Duff, Sorensen, van der Vorst, "Numerical Linear Algebra for High-Performance Computers", 1998,
// section 7.3 ("burn at both ends").
template <class Run>
std::vector<double> solve_rows(const Run& p, const EndRow& first, const EndRow& last) {
  const std::size_t spans = p.spans(), d = p.dimensions(), middle = (spans + 1) / 2;
  std::vector<double> slopes((spans + 1) * d);
  const auto ratios = std::make_unique_for_overwrite<double[]>(spans + 1);
  Elimination<Run> up(p, first, 0), down(p, last, spans - 1);
  const auto keep = [&](const Elimination<Run>& row, std::size_t k) {
    ratios[k] = row.ratio;
    for (std::size_t c = 0; c < d; ++c) slopes[k * d + c] = row.slope[c];
  };
  keep(up, 0);
  keep(down, spans);
  // As many rows below the middle as above it, or one more.
  for (std::size_t k = 1; k < middle; ++k) {
    up.pass(k);
    keep(up, k);
    const std::size_t other = spans - k;
    if (other == middle) break;
    down.pass(other - 1);
    keep(down, other);
  }
  if (middle == spans) {  // there is but one span
    for (std::size_t c = 0; c < d; ++c)
      slopes[d + c] = (down.slope[c] - down.ratio * up.slope[c]) / (1 - down.ratio * up.ratio);
  } else {
    // The row in the middle, whose neighbors both are done.
    const double whole = 1 / (up.duration + down.duration);
    const double ahead = down.duration * whole, behind = up.duration * whole;
    const double pivot = 2 - (ahead * up.ratio + behind * down.ratio);
    for (std::size_t c = 0; c < d; ++c) {
      const double right = 3 * (ahead * up.secant[c] + behind * down.secant[c]);
      slopes[middle * d + c] = (right - (ahead * up.slope[c] + behind * down.slope[c])) / pivot;
    }
  }
  for (std::size_t k = 1; k <= middle; ++k)
    for (std::size_t c = 0; c < d; ++c) {
      slopes[(middle - k) * d + c] -= ratios[middle - k] * slopes[(middle - k + 1) * d + c];
      if (middle + k <= spans) slopes[(middle + k) * d + c] -= ratios[middle + k] * slopes[(middle + k - 1) * d + c];
    }
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
