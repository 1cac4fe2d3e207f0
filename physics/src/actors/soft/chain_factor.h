#pragma once

#include <cstddef>
#include <vector>

#include "actors/soft/node_order.h"

namespace tweenfall::soft {

/// A symmetric matrix of blocks of three by three, of which only those near the diagonal are not zero: that of a chain,
/// whose nodes are joined to those of neighboring places, or of a cloth or a box, whose rows are. It is solved in a
/// time that grows with the nodes and the square of how far they reach, where conjugate gradients need a step for each
/// of them until one end has heard of the other, and of what is very stiff never come to an end.
class ChainFactor {
 public:
  /// Starts with a matrix of zeros. @param order  of as many nodes; must outlive the matrix. Its reach is at least 1
  void clear(const NodeOrder& order);
  /// Of as many nodes, all of them joined.
  void clear(std::size_t nodes);
  /// @param i, j  their blocks are added on both sides of the diagonal; each pair is given once
  void add(std::size_t i, std::size_t j, const Mat3& block);
  /// As it was filled in; zero for blocks farther apart than `reach`.
  [[nodiscard]] Mat3 block(std::size_t i, std::size_t j) const;
  /// All nodes of which blocks with this one are kept, itself among them.
  [[nodiscard]] std::vector<std::size_t> nodes_near(std::size_t node) const;
  /// Removes a node from the unknowns: it stays where it is.
  void fix(std::size_t node);

  /// As L D L'. @return whether it is definite
  [[nodiscard]] bool factor();
  /// @param values  the first of them, one per node, are replaced by their solution
  void solve(std::vector<Vec3>& values) const;

 private:
  [[nodiscard]] double& at(std::size_t row, std::size_t column) { return rows_[row * width_ + column + band_ - row]; }
  [[nodiscard]] std::size_t place_of(std::size_t node) const { return order_ ? order_->place_of(node) : node; }
  [[nodiscard]] std::size_t node_at(std::size_t place) const { return order_ ? order_->node_at(place) : place; }
  void clear(std::size_t nodes, std::size_t reach);
  void solve_in_place(double* value) const;

  const NodeOrder* order_ = nullptr;  ///< none: nodes are where their numbers put them
  std::size_t nodes_ = 0, size_ = 0;
  std::size_t band_ = 0, width_ = 1;  ///< numbers of a row before its diagonal, and including it
  std::vector<double> rows_;          ///< by row, up to the diagonal
  std::vector<double> columns_;       ///< of the factor, by column, from the diagonal down
};

}  // namespace tweenfall::soft
