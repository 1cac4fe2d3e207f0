#include "slopes/c2_slopes.h"

#include <tweenfall/curves/number_text.h>

#include <cmath>
#include <stdexcept>

#include "math/tridiagonal.h"

namespace tweenfall::slopes {
namespace {

// h1 m[k-1] + 2 (h0 + h1) m[k] + h0 m[k+1] = 3 (h1 d0 + h0 d1), divided by h0 + h1, for the key between spans a and b.
void fill_inner_row(math::Tridiagonal& rows, std::size_t row, const SlopeProblem& p, std::size_t a, std::size_t b) {
  const double total = p.durations[a] + p.durations[b];
  const double h0 = p.durations[a] / total, h1 = p.durations[b] / total;
  rows.lower[row] = h1;
  rows.diagonal[row] = 2;
  rows.upper[row] = h0;
  for (std::size_t c = 0; c < p.dimensions; ++c) rows.at(row, c) = 3 * (h1 * p.secant(a, c) + h0 * p.secant(b, c));
}

// The row of a run's first key (or last, seen backwards): `own` is its span, `next` the one after that.
void fill_end_row(math::Tridiagonal& rows, std::size_t row, std::vector<double>& coupling, const SlopeProblem& p,
                  const C2End& end, std::size_t own, std::size_t next, double sign) {
  const double h = p.durations[own];
  if (end.kind == C2End::Kind::not_a_knot && own != next) {
    const double total = h + p.durations[next];
    const double h0 = h / total, h1 = p.durations[next] / total;
    rows.diagonal[row] = h1;
    coupling[row] = 1;
    for (std::size_t c = 0; c < p.dimensions; ++c)
      rows.at(row, c) = (h0 + 2) * h1 * p.secant(own, c) + h0 * h0 * p.secant(next, c);
    return;
  }
  for (std::size_t c = 0; c < p.dimensions; ++c) {
    const double given = end.given.empty() ? 0 : end.given[c];
    if (end.kind == C2End::Kind::second) {
      rows.diagonal[row] = 2;
      coupling[row] = 1;
      rows.at(row, c) = 3 * p.secant(own, c) - sign * 0.5 * h * given;
    } else {
      rows.diagonal[row] = 1;
      rows.at(row, c) = end.kind == C2End::Kind::slope ? given : p.secant(own, c);
    }
  }
}

// Both ends of a parabola through three values.
void fit_parabola(const SlopeProblem& p, C2End& start, C2End& end) {
  const std::size_t a = p.first, b = p.first + 1;
  const double h0 = p.durations[a], h1 = p.durations[b];
  start = end = {C2End::Kind::slope, std::vector<double>(p.dimensions)};
  for (std::size_t c = 0; c < p.dimensions; ++c) {
    const double change = p.secant(b, c) - p.secant(a, c);
    start.given[c] = p.secant(a, c) - h0 / (h0 + h1) * change;
    end.given[c] = p.secant(b, c) + h1 / (h0 + h1) * change;
  }
}

void store(const SlopeProblem& p, math::Tridiagonal& rows, bool periodic) {
  const std::size_t count = p.last - p.first;
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t c = 0; c < p.dimensions; ++c) {
      p.leaving[(p.first + k) * p.dimensions + c] = rows.at(k, c);
      p.arriving[(p.first + k) * p.dimensions + c] = rows.at(periodic && k + 1 == count ? 0 : k + 1, c);
    }
}

}  // namespace

void solve_c2(const SlopeProblem& p, const C2End& given_start, const C2End& given_end) {
  C2End start = given_start, end = given_end;
  const std::size_t spans = p.last - p.first;
  const bool both_free = start.kind == C2End::Kind::not_a_knot && end.kind == C2End::Kind::not_a_knot;
  if (both_free && spans == 2) fit_parabola(p, start, end);
  math::Tridiagonal rows(spans + 1, p.dimensions);
  const std::size_t last = p.last - 1;
  fill_end_row(rows, 0, rows.upper, p, start, p.first, spans > 1 ? p.first + 1 : p.first, 1);
  for (std::size_t k = 1; k < spans; ++k) fill_inner_row(rows, k, p, p.first + k - 1, p.first + k);
  fill_end_row(rows, spans, rows.lower, p, end, last, spans > 1 ? last - 1 : last, -1);
  rows.solve();
  store(p, rows, false);
}

void solve_c2_periodic(const SlopeProblem& p) {
  const std::size_t spans = p.last - p.first, d = p.dimensions;
  if (spans == 1) {
    for (std::size_t c = 0; c < d; ++c) p.leaving[p.first * d + c] = p.arriving[p.first * d + c] = p.secant(p.first, c);
    return;
  }
  math::Tridiagonal rows(spans, d);
  for (std::size_t k = 0; k < spans; ++k) {
    const std::size_t a = p.first + (k > 0 ? k - 1 : spans - 1);
    fill_inner_row(rows, k, p, a, p.first + k);
  }
  rows.solve_cyclic();
  store(p, rows, true);
}

void solve_c2_automatic(const SlopeProblem& p, C2End::Kind usual) {
  const bool whole = p.first == 0 && p.last == p.spans;
  if (p.ends == Ends::wrap && whole) return solve_c2_periodic(p);
  const auto kind = [&p, usual](bool at_end_of_curve) {
    return p.ends == Ends::flat && at_end_of_curve ? C2End::Kind::slope : usual;
  };
  solve_c2(p, {kind(p.first == 0)}, {kind(p.last == p.spans)});
}

void check_ends(const char* what, double start, double end) {
  for (const double v : {start, end})
    if (!std::isfinite(v))
      throw std::invalid_argument(std::string("the ") + what + " at the ends must be finite; one is " + number_text(v));
}

}  // namespace tweenfall::slopes
