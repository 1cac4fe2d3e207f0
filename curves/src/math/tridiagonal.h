#pragma once

// Tridiagonal systems: each equation ties an unknown to its two neighbors.

#include <cstddef>
#include <vector>

namespace tweenfall::math {

/// lower[i] x[i-1] + diagonal[i] x[i] + upper[i] x[i+1] = right, for several right-hand sides (columns) at once.
struct Tridiagonal {
  std::vector<double> lower, diagonal, upper, right;
  std::size_t columns;

  explicit Tridiagonal(std::size_t rows, std::size_t right_sides = 1)
      : lower(rows), diagonal(rows), upper(rows), right(rows * right_sides), columns(right_sides) {}

  [[nodiscard]] std::size_t rows() const noexcept { return diagonal.size(); }
  double& at(std::size_t row, std::size_t column) { return right[row * columns + column]; }

  /// Turns the right-hand sides into the solutions; first and last row have one neighbor.
  /// Precondition: diagonally dominant, or nearly so, for there is no pivoting.
  void solve();

  /// The same for a cycle: the first and the last row are neighbors.
  void solve_cyclic();
};

}  // namespace tweenfall::math
