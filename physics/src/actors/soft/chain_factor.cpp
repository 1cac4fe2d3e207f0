// Source: Golub, Van Loan, Matrix Computations, 4th edition, 2013, 4.3.5 (band Cholesky), here as L D L'.

#include "actors/soft/chain_factor.h"

#include <algorithm>

namespace tweenfall::soft {

void ChainFactor::clear(const NodeOrder& order) {
  clear(order.size(), order.reach());
  order_ = &order;
}

void ChainFactor::clear(std::size_t nodes) {
  clear(nodes, nodes);
  order_ = nullptr;
}

void ChainFactor::clear(std::size_t nodes, std::size_t reach) {
  nodes_ = nodes;
  size_ = 3 * nodes;
  band_ = 3 * reach + 2;
  width_ = band_ + 1;
  rows_.assign(size_ * width_, 0);
}

std::vector<std::size_t> ChainFactor::nodes_near(std::size_t node) const {
  const std::size_t place = place_of(node), reach = band_ / 3;
  std::vector<std::size_t> near;
  for (std::size_t other = place - std::min(place, reach); other < std::min(nodes_, place + reach + 1); ++other)
    near.push_back(node_at(other));
  return near;
}

void ChainFactor::add(std::size_t i, std::size_t j, const Mat3& block) {
  const std::size_t at_i = place_of(i), at_j = place_of(j);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      const std::size_t row = 3 * at_i + static_cast<std::size_t>(r), column = 3 * at_j + static_cast<std::size_t>(c);
      if (column <= row)
        at(row, column) += block(r, c);
      else if (i != j)
        at(column, row) += block(r, c);
    }
}

Mat3 ChainFactor::block(std::size_t i, std::size_t j) const {
  const std::size_t at_i = place_of(i), at_j = place_of(j);
  Mat3 found = Mat3::Zero();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      const std::size_t row = 3 * at_i + static_cast<std::size_t>(r), column = 3 * at_j + static_cast<std::size_t>(c);
      const std::size_t low = std::max(row, column), high = std::min(row, column);
      if (low - high <= band_) found(r, c) = rows_[low * width_ + high + band_ - low];
    }
  return found;
}

void ChainFactor::fix(std::size_t node) {
  const std::size_t place = place_of(node);
  for (std::size_t own = 3 * place; own < 3 * place + 3; ++own) {
    for (std::size_t other = own - std::min(own, band_); other <= own; ++other) at(own, other) = 0;
    for (std::size_t other = own + 1; other < std::min(size_, own + width_); ++other) at(other, own) = 0;
    at(own, own) = 1;
  }
}

bool ChainFactor::factor() {
  columns_.resize(size_ * width_);
  for (std::size_t i = 0; i < size_; ++i) {
    const std::size_t first = i - std::min(i, band_);
    double* const row = &rows_[i * width_ + band_ - i];
    // Each entry, once the columns before have been taken off it, is taken off the entries behind it. Rows hold L D
    // until they are divided by D.
    for (std::size_t k = first; k < i; ++k) {
      const double taken = row[k];
      const double* const column = &columns_[k * width_ - k];
      for (std::size_t j = k + 1; j < i; ++j) row[j] -= taken * column[j];
    }
    double left = row[i];
    for (std::size_t j = first; j < i; ++j) {
      const double scaled = row[j] / at(j, j);
      left -= scaled * row[j];
      row[j] = scaled;
      columns_[j * width_ + i - j] = scaled;
    }
    if (!(left > 0)) return false;
    row[i] = left;
  }
  return true;
}

void ChainFactor::solve(std::vector<Vec3>& values) const {
  if (!order_ || order_->is_natural()) return solve_in_place(values.front().data());
  std::vector<Vec3> ordered(nodes_);
  for (std::size_t place = 0; place < nodes_; ++place) ordered[place] = values[node_at(place)];
  solve_in_place(ordered.front().data());
  for (std::size_t place = 0; place < nodes_; ++place) values[node_at(place)] = ordered[place];
}

void ChainFactor::solve_in_place(double* value) const {
  for (std::size_t i = 0; i < size_; ++i) {
    const double* const column = &columns_[i * width_ - i];
    const double known = value[i];
    for (std::size_t j = i + 1; j < std::min(size_, i + width_); ++j) value[j] -= column[j] * known;
  }
  for (std::size_t i = 0; i < size_; ++i) value[i] /= rows_[i * width_ + band_];
  for (std::size_t i = size_; i-- > 0;) {
    const double* const row = &rows_[i * width_ + band_ - i];
    const double known = value[i];
    for (std::size_t j = i - std::min(i, band_); j < i; ++j) value[j] -= row[j] * known;
  }
}

}  // namespace tweenfall::soft
