// Source: Golub, Van Loan, Matrix Computations, 4th edition, 2013, 4.3.5 (band Cholesky), here as L D L'.

#include "actors/soft/chain_factor.h"

#include <algorithm>

namespace tweenfall::soft {

std::size_t ChainFactor::reach_of(const SoftSettings& made) {
  if (!made.enclosures.empty()) return 0;
  std::size_t reach = 0;
  const auto join = [&reach](std::uint32_t a, std::uint32_t b) {
    reach = std::max<std::size_t>(reach, a > b ? a - b : b - a);
  };
  for (const SoftEdge& edge : made.edges) join(edge.a, edge.b);
  for (const SoftBend& bend : made.bends)
    for (std::size_t k = 1; k < 4; ++k)
      for (std::size_t other = 0; other < k; ++other)
        if (bend.weights[k] != 0 && bend.weights[other] != 0) join(bend.nodes[k], bend.nodes[other]);
  for (const SoftTetrahedron& solid : made.tetrahedra)
    for (std::size_t k = 1; k < 4; ++k)
      for (std::size_t other = 0; other < k; ++other) join(solid.nodes[k], solid.nodes[other]);
  return reach <= most_reach ? reach : 0;
}

void ChainFactor::clear(std::size_t nodes, std::size_t reach) {
  nodes_ = nodes;
  size_ = 3 * nodes;
  band_ = 3 * reach + 2;
  width_ = band_ + 1;
  rows_.assign(size_ * width_, 0);
}

void ChainFactor::add(std::size_t i, std::size_t j, const Mat3& block) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      const std::size_t row = 3 * i + static_cast<std::size_t>(r), column = 3 * j + static_cast<std::size_t>(c);
      if (column <= row)
        at(row, column) += block(r, c);
      else if (i != j)
        at(column, row) += block(r, c);
    }
}

Mat3 ChainFactor::block(std::size_t i, std::size_t j) const {
  Mat3 found = Mat3::Zero();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      const std::size_t row = 3 * i + static_cast<std::size_t>(r), column = 3 * j + static_cast<std::size_t>(c);
      const std::size_t low = std::max(row, column), high = std::min(row, column);
      if (low - high <= band_) found(r, c) = rows_[low * width_ + high + band_ - low];
    }
  return found;
}

void ChainFactor::fix(std::size_t node) {
  for (std::size_t own = 3 * node; own < 3 * node + 3; ++own) {
    for (std::size_t other = own - std::min(own, band_); other <= own; ++other) at(own, other) = 0;
    for (std::size_t other = own + 1; other < std::min(size_, own + width_); ++other) at(other, own) = 0;
    at(own, own) = 1;
  }
}

bool ChainFactor::factor() {
  for (std::size_t i = 0; i < size_; ++i) {
    const std::size_t first = i - std::min(i, band_);
    // Rows hold L D until they are divided by D.
    for (std::size_t j = first; j < i; ++j) {
      double sum = at(i, j);
      for (std::size_t k = std::max(first, j - std::min(j, band_)); k < j; ++k) sum -= at(i, k) * at(j, k);
      at(i, j) = sum;
    }
    double left = at(i, i);
    for (std::size_t j = first; j < i; ++j) {
      const double scaled = at(i, j) / at(j, j);
      left -= scaled * at(i, j);
      at(i, j) = scaled;
    }
    if (!(left > 0)) return false;
    at(i, i) = left;
  }
  return true;
}

void ChainFactor::solve(std::vector<Vec3>& values) const {
  const auto value = [&values](std::size_t i) -> double& { return values[i / 3][static_cast<Eigen::Index>(i % 3)]; };
  for (std::size_t i = 0; i < size_; ++i) {
    const double* row = &rows_[i * width_];
    double sum = value(i);
    for (std::size_t j = i - std::min(i, band_); j < i; ++j) sum -= row[j + band_ - i] * value(j);
    value(i) = sum;
  }
  for (std::size_t i = 0; i < size_; ++i) value(i) /= rows_[i * width_ + band_];
  for (std::size_t i = size_; i-- > 0;) {
    const double* row = &rows_[i * width_];
    const double known = value(i);
    for (std::size_t j = i - std::min(i, band_); j < i; ++j) value(j) -= row[j + band_ - i] * known;
  }
}

}  // namespace tweenfall::soft
