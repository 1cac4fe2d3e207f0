#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace tweenfall::forces {

/// A square system, solved by Gaussian elimination with partial pivoting.
class Elimination {
 public:
  std::vector<double> entries;  ///< row by row; replaced by the factors

  void factor(std::size_t size) {
    size_ = size;
    rows_.resize(size);
    for (std::size_t column = 0; column < size; ++column) {
      std::size_t pivot = column;
      for (std::size_t row = column + 1; row < size; ++row)
        if (std::abs(at(row, column)) > std::abs(at(pivot, column))) pivot = row;
      rows_[column] = pivot;
      if (pivot != column)
        for (std::size_t k = 0; k < size; ++k) std::swap(at(pivot, k), at(column, k));
      if (at(column, column) == 0) continue;
      for (std::size_t row = column + 1; row < size; ++row) {
        const double share = at(row, column) /= at(column, column);
        if (share == 0) continue;
        for (std::size_t k = column + 1; k < size; ++k) at(row, k) -= share * at(column, k);
      }
    }
  }
  /// In place; unknowns that the system does not determine become 0.
  void solve(std::span<double> values) const {
    for (std::size_t row = 0; row < size_; ++row) std::swap(values[row], values[rows_[row]]);
    for (std::size_t row = 0; row < size_; ++row)
      for (std::size_t k = row + 1; k < size_; ++k) values[k] -= at(k, row) * values[row];
    for (std::size_t row = size_; row-- > 0;) {
      for (std::size_t k = row + 1; k < size_; ++k) values[row] -= at(row, k) * values[k];
      values[row] = at(row, row) == 0 ? 0 : values[row] / at(row, row);
    }
  }

 private:
  double& at(std::size_t row, std::size_t column) { return entries[row * size_ + column]; }
  [[nodiscard]] double at(std::size_t row, std::size_t column) const { return entries[row * size_ + column]; }

  std::size_t size_ = 0;
  std::vector<std::size_t> rows_;
};

}  // namespace tweenfall::forces
