#include "strategies/solvers/lemke.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tweenfall::strategies {

namespace {

/// Rounding of a pivot, relative.
constexpr double no_pivot = 1e-10;
/// How often a solution is refined by its residual.
constexpr int refinements = 3;

/// The tableau of w - A z - z0 = q: basic variables in terms of the others. Columns are w, z, z0 and at last q.
class Tableau {
 public:
  Tableau(std::span<const double> matrix, std::span<const double> q)
      : count_(q.size()), width_(2 * count_ + 2), matrix_(matrix), q_(q), entries_(count_ * width_), basic_(count_) {
    for (std::size_t row = 0; row < count_; ++row) {
      at(row, row) = 1;
      for (std::size_t column = 0; column < count_; ++column) at(row, count_ + column) = -matrix[row * count_ + column];
      at(row, cover()) = -1;
      at(row, width_ - 1) = q[row];
      basic_[row] = row;
    }
  }

  [[nodiscard]] bool solve() {
    const auto least = static_cast<std::size_t>(std::min_element(q_.begin(), q_.end()) - q_.begin());
    if (q_[least] >= 0) return true;
    std::size_t leaving = pivot(least, cover());
    for (std::size_t k = 0; k < 60 * count_ + 100; ++k) {
      const std::size_t entering = leaving < count_ ? leaving + count_ : leaving - count_;
      const std::size_t row = row_to_leave(entering);
      if (row == count_) return false;
      leaving = pivot(row, entering);
      if (leaving == cover()) return true;
    }
    return false;
  }

  /// Computes the basic variables from the original problem, as pivots have gathered rounding.
  void read(std::span<double> z) const {
    std::vector<double> values(count_), left(q_.begin(), q_.end());
    for (int k = 0; k < refinements; ++k) {
      for (std::size_t row = 0; row < count_; ++row)
        for (std::size_t i = 0; i < count_; ++i) values[row] += at(row, i) * left[i];
      std::copy(q_.begin(), q_.end(), left.begin());
      for (std::size_t row = 0; row < count_; ++row) {
        const std::size_t column = basic_[row];
        if (column < count_) {
          left[column] -= values[row];
          continue;
        }
        for (std::size_t i = 0; i < count_; ++i) left[i] += matrix_[i * count_ + column - count_] * values[row];
      }
    }
    std::fill(z.begin(), z.end(), 0.0);
    for (std::size_t row = 0; row < count_; ++row)
      if (basic_[row] >= count_) z[basic_[row] - count_] = std::max(0.0, values[row]);
  }

 private:
  [[nodiscard]] std::size_t cover() const { return 2 * count_; }
  double& at(std::size_t row, std::size_t column) { return entries_[row * width_ + column]; }
  [[nodiscard]] double at(std::size_t row, std::size_t column) const { return entries_[row * width_ + column]; }

  /// The first row that the entering variable would make negative; `count_` if it may grow forever.
  [[nodiscard]] std::size_t row_to_leave(std::size_t entering) const {
    std::size_t best = count_;
    for (std::size_t row = 0; row < count_; ++row) {
      if (!(at(row, entering) > no_pivot)) continue;
      if (best == count_ || before(row, best, entering)) best = row;
    }
    return best;
  }
  [[nodiscard]] bool before(std::size_t row, std::size_t other, std::size_t entering) const {
    const double share = at(row, entering), other_share = at(other, entering);
    const auto less = [&](std::size_t column) {
      const double ratio = at(row, column) / share, other_ratio = at(other, column) / other_share;
      return std::abs(ratio - other_ratio) <= 1e-13 * (1 + std::abs(ratio)) ? 0 : ratio < other_ratio ? -1 : 1;
    };
    if (const int order = less(width_ - 1); order != 0) return order < 0;
    // The one that ends the method goes first.
    if (basic_[row] == cover() || basic_[other] == cover()) return basic_[row] == cover();
    for (std::size_t column = 0; column < count_; ++column)
      if (const int order = less(column); order != 0) return order < 0;
    return false;
  }

  /// @return the leaving variable
  std::size_t pivot(std::size_t row, std::size_t entering) {
    const double share = 1 / at(row, entering);
    for (std::size_t column = 0; column < width_; ++column) at(row, column) *= share;
    for (std::size_t other = 0; other < count_; ++other) {
      const double part = at(other, entering);
      if (other == row || part == 0) continue;
      for (std::size_t column = 0; column < width_; ++column) at(other, column) -= part * at(row, column);
    }
    return std::exchange(basic_[row], entering);
  }

  std::size_t count_, width_;
  std::span<const double> matrix_, q_;
  std::vector<double> entries_;
  std::vector<std::size_t> basic_;  ///< by row: its column
};

}  // namespace

bool solve_by_lemke(std::span<const double> matrix, std::span<const double> q, std::span<double> z) {
  Tableau tableau(matrix, q);
  if (!tableau.solve()) return false;
  tableau.read(z);
  return std::all_of(z.begin(), z.end(), [](double number) { return std::isfinite(number); });
}

}  // namespace tweenfall::strategies
