#include <algorithm>
#include <vector>

#include "slope_rule.h"

namespace tweenfall {
namespace {

// Thomas' algorithm; the matrix is diagonally dominant. `right` becomes the solution.
void solve_tridiagonal(const std::vector<double>& lower, std::vector<double> diagonal, const std::vector<double>& upper,
                       std::vector<double>& right) {
  const std::size_t n = diagonal.size();
  for (std::size_t i = 1; i < n; ++i) {
    const double f = lower[i] / diagonal[i - 1];
    diagonal[i] -= f * upper[i - 1];
    right[i] -= f * right[i - 1];
  }
  right[n - 1] /= diagonal[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) right[i] = (right[i] - upper[i] * right[i + 1]) / diagonal[i];
}

}  // namespace

// Slopes m for which the second derivative is continuous:
//     h1 m[k-1] + 2 (h0 + h1) m[k] + h0 m[k+1] = 3 (h1 d0 + h0 d1).
// Source: de Boor, "A Practical Guide to Splines", chapter IV.
void slopes_natural(const SlopeProblem& p) {
  const bool periodic = p.ends == Ends::wrap && p.first == 0 && p.last == p.spans && p.spans > 1;
  const std::size_t keys = p.last - p.first + (periodic ? 0 : 1);
  std::vector<double> lower(keys), diagonal(keys), upper(keys), right(keys), correction(keys);
  for (std::size_t c = 0; c < p.dimensions; ++c) {
    for (std::size_t k = 0; k < keys; ++k) {
      const std::size_t key = p.first + k;
      if (!periodic && (k == 0 || k + 1 == keys)) {
        const std::size_t span = k == 0 ? p.first : p.last - 1;
        const bool flat = p.ends == Ends::flat && (key == 0 || key == p.spans);
        lower[k] = upper[k] = flat ? 0 : 1;
        diagonal[k] = flat ? 1 : 2;
        right[k] = flat ? 0 : 3 * p.secant(span, c);
        continue;
      }
      const std::size_t a = p.before(key), b = p.after(key);
      const double total = p.durations[a] + p.durations[b];
      const double h0 = p.durations[a] / total, h1 = p.durations[b] / total;
      lower[k] = h1;
      diagonal[k] = 2;
      upper[k] = h0;
      right[k] = 3 * (h1 * p.secant(a, c) + h0 * p.secant(b, c));
    }
    if (periodic) {
      // The two corner entries, by Sherman and Morrison: A = B + u v^T with u = (g, 0, ..., upper), v = (1, 0, ...,
      // lower/g).
      const double g = -diagonal[0], corner_low = upper[keys - 1], corner_high = lower[0];
      std::vector<double> changed = diagonal;
      changed[0] -= g;
      changed[keys - 1] -= corner_low * corner_high / g;
      std::fill(correction.begin(), correction.end(), 0.0);
      correction[0] = g;
      correction[keys - 1] += corner_low;
      solve_tridiagonal(lower, changed, upper, right);
      solve_tridiagonal(lower, changed, upper, correction);
      const double ratio = corner_high / g;
      const double f = (right[0] + ratio * right[keys - 1]) / (1 + correction[0] + ratio * correction[keys - 1]);
      for (std::size_t k = 0; k < keys; ++k) right[k] -= f * correction[k];
    } else {
      solve_tridiagonal(lower, diagonal, upper, right);
    }
    for (std::size_t i = p.first; i < p.last; ++i) {
      p.leaving[i * p.dimensions + c] = right[i - p.first];
      p.arriving[i * p.dimensions + c] = right[(i + 1 - p.first) % keys];
    }
  }
}

}  // namespace tweenfall
