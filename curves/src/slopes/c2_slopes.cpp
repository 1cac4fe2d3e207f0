#include "slopes/c2_slopes.h"

#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "math/tridiagonal.h"
#include "slopes/c2_rows.h"

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

struct Run {
  const SlopeProblem& problem;

  [[nodiscard]] std::size_t spans() const noexcept { return problem.last - problem.first; }
  [[nodiscard]] std::size_t dimensions() const noexcept { return problem.dimensions; }
  [[nodiscard]] double duration(std::size_t span) const noexcept { return problem.durations[problem.first + span]; }
  [[nodiscard]] double secant(std::size_t span, std::size_t c) const noexcept {
    return problem.secant(problem.first + span, c);
  }
};

// @param slopes at the run's keys, without the last one where the run is a period
void store(const SlopeProblem& p, const std::vector<double>& slopes) {
  const std::size_t count = (p.last - p.first) * p.dimensions;
  double *leaving = p.leaving + p.first * p.dimensions, *arriving = p.arriving + p.first * p.dimensions;
  std::copy_n(slopes.begin(), count, leaving);
  const std::size_t own = std::min(count, slopes.size() - p.dimensions);  // arriving at the run's own keys
  std::copy_n(slopes.begin() + static_cast<std::ptrdiff_t>(p.dimensions), own, arriving);
  std::copy_n(slopes.begin(), count - own, arriving + own);
}

}  // namespace

void solve_c2(const SlopeProblem& problem, const C2End& start, const C2End& end) {
  store(problem, c2_slopes(Run{problem}, start, end));
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
  store(p, rows.right);
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
