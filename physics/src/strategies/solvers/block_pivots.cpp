#include "strategies/solvers/block_pivots.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::strategies {

namespace {

/// How often rows may change sides together without fewer of them being wrong than ever before.
constexpr int most_patience = 6;
/// How often a solution is refined by its residual.
constexpr int most_refinements = 3;

}  // namespace

BlockPivots::BlockPivots(std::span<const double> matrix, std::span<const double> slack)
    : count_(slack.size()), matrix_(matrix), slack_(slack), pressing_(count_), values_(count_), parting_(count_) {}

bool BlockPivots::factor() {
  if (factored_ == pressing_) return true;
  factored_.clear();
  rows_.clear();
  for (std::uint32_t i = 0; i < count_; ++i)
    if (pressing_[i] != 0) rows_.push_back(i);
  const std::size_t size = rows_.size();
  factor_.resize(size * size);
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t k = 0; k < size; ++k) factor_[i * size + k] = matrix_[rows_[i] * count_ + rows_[k]];
  // The upper half, row by row: entries between bodies that do not touch stay 0 and are skipped.
  for (std::size_t i = 0; i < size; ++i) {
    const double* row = &factor_[i * size];
    if (!(row[i] > 0)) return false;
    for (std::size_t k = i + 1; k < size; ++k) {
      const double part = row[k] / row[i];
      if (part == 0) continue;
      double* other = &factor_[k * size];
      for (std::size_t j = k; j < size; ++j) other[j] -= part * row[j];
    }
  }
  factored_ = pressing_;
  return true;
}

/// Finds the impulses of the pressing rows such that they part as they should, and how all others part.
void BlockPivots::find(std::span<const double> q) {
  const std::size_t size = rows_.size();
  std::fill(values_.begin(), values_.end(), 0.0);
  left_.resize(size);
  for (int k = 0; k <= most_refinements; ++k) {
    for (std::size_t i = 0; i < count_; ++i) {
      double sum = q[i];
      const double* row = &matrix_[i * count_];
      for (const std::uint32_t column : rows_) sum += row[column] * values_[column];
      parting_[i] = sum;
    }
    bool enough = true;
    for (std::size_t i = 0; i < size; ++i) {
      left_[i] = -parting_[rows_[i]];
      enough = enough && std::abs(left_[i]) <= 0.1 * slack_[rows_[i]];
    }
    if (enough || k == most_refinements) return;
    solve_factored();
    for (std::size_t i = 0; i < size; ++i) values_[rows_[i]] += left_[i];
  }
}

void BlockPivots::solve_factored() {
  const std::size_t size = rows_.size();
  for (std::size_t i = 0; i < size; ++i) {
    const double* row = &factor_[i * size];
    const double part = left_[i] / row[i];
    for (std::size_t j = i + 1; j < size; ++j) left_[j] -= part * row[j];
  }
  for (std::size_t i = size; i-- > 0;) {
    const double* row = &factor_[i * size];
    double sum = left_[i];
    for (std::size_t j = i + 1; j < size; ++j) sum -= row[j] * left_[j];
    left_[i] = sum / row[i];
  }
}

bool BlockPivots::correct(std::span<const double> parting, std::span<const double> z, std::span<double> change) {
  for (std::size_t i = 0; i < count_; ++i) pressing_[i] = z[i] > 0;
  if (!factor()) return false;
  left_.resize(rows_.size());
  for (std::size_t i = 0; i < rows_.size(); ++i) left_[i] = -parting[rows_[i]];
  solve_factored();
  std::fill(change.begin(), change.end(), 0.0);
  for (std::size_t i = 0; i < rows_.size(); ++i) change[rows_[i]] = left_[i];
  return true;
}

bool BlockPivots::solve(std::span<const double> q, std::span<double> z) {
  for (std::size_t i = 0; i < count_; ++i) pressing_[i] = z[i] > 0;
  std::size_t fewest = count_ + 1;
  int patience = most_patience;
  for (std::size_t round = 0; round < 3 * count_ + 100; ++round) {
    if (!factor()) return false;
    find(q);
    std::size_t wrong = 0, last = count_;
    const auto is_wrong = [&](std::size_t i) { return (pressing_[i] != 0 ? values_[i] : parting_[i]) < -slack_[i]; };
    for (std::size_t i = 0; i < count_; ++i)
      if (is_wrong(i)) {
        ++wrong;
        last = i;
      }
    if (wrong == 0) {
      for (std::size_t i = 0; i < count_; ++i) z[i] = std::max(0.0, values_[i]);
      return std::all_of(z.begin(), z.end(), [](double number) { return std::isfinite(number); });
    }
    if (wrong < fewest) {
      fewest = wrong;
      patience = most_patience;
    } else {
      --patience;
    }
    for (std::size_t i = patience >= 0 ? 0 : last; i <= last; ++i)
      if (patience >= 0 ? is_wrong(i) : i == last) pressing_[i] = pressing_[i] == 0;
  }
  return false;
}

}  // namespace tweenfall::strategies
