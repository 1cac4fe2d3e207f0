#include "math/tridiagonal.h"

namespace tweenfall::math {

// Thomas' algorithm.
void Tridiagonal::solve() {
  const std::size_t n = rows();
  for (std::size_t i = 1; i < n; ++i) {
    const double f = lower[i] / diagonal[i - 1];
    diagonal[i] -= f * upper[i - 1];
    for (std::size_t c = 0; c < columns; ++c) at(i, c) -= f * at(i - 1, c);
  }
  for (std::size_t c = 0; c < columns; ++c) at(n - 1, c) /= diagonal[n - 1];
  for (std::size_t i = n - 1; i-- > 0;)
    for (std::size_t c = 0; c < columns; ++c) at(i, c) = (at(i, c) - upper[i] * at(i + 1, c)) / diagonal[i];
}

// The two corner entries by the Sherman-Morrison formula: A = B + u v^T with u = (g, 0, ..., low), v = (1, 0, ..., high
// / g); an additional column solves for u.
void Tridiagonal::solve_cyclic() {
  const std::size_t n = rows();
  const double g = -diagonal[0], low = upper[n - 1], high = lower[0];
  if (low == 0 && high == 0) return solve();
  Tridiagonal plain(n, columns + 1);
  plain.lower = lower;
  plain.diagonal = diagonal;
  plain.upper = upper;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t c = 0; c < columns; ++c) plain.at(i, c) = at(i, c);
  plain.diagonal[0] -= g;
  plain.diagonal[n - 1] -= low * high / g;
  plain.at(0, columns) = g;
  plain.at(n - 1, columns) += low;
  plain.solve();
  const double ratio = high / g, scale = 1 + plain.at(0, columns) + ratio * plain.at(n - 1, columns);
  for (std::size_t c = 0; c < columns; ++c) {
    const double f = (plain.at(0, c) + ratio * plain.at(n - 1, c)) / scale;
    for (std::size_t i = 0; i < n; ++i) at(i, c) = plain.at(i, c) - f * plain.at(i, columns);
  }
}

}  // namespace tweenfall::math
