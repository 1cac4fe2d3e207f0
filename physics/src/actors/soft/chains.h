#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "actors/soft/soft_state.h"

namespace tweenfall::soft {

/// Edges one after the other.
struct Chain {
  std::vector<std::uint32_t> edges;
  std::vector<std::uint32_t> nodes;  ///< one more than edges: each edge joins the node of its index and the next
};

/// All edges that are not torn, in chains from end to end; a ring is opened at an edge, which is a chain of its own.
/// Empty if a node has more than two edges.
[[nodiscard]] std::vector<Chain> chains_of(const SoftBody& body);

/// The chains of a soft body, kept until it tears.
class KeptChains {
 public:
  [[nodiscard]] const std::vector<Chain>& of(const SoftBody& body);

 private:
  std::shared_ptr<const SoftSettings> made_;  ///< of the body that they are of
  std::vector<char> torn_;
  std::vector<Chain> chains_;
};

/// Solves a symmetric, semidefinite tridiagonal system: values become its solution.
/// @param diagonal  becomes its pivots @param beside  the entry of each with the one before it; the first is not read
/// Source: Golub, Van Loan, Matrix Computations, 4th edition, 2013, 4.3.6.
void solve_three_diagonals(std::vector<double>& diagonal, const std::vector<double>& beside,
                           std::vector<double>& values);

}  // namespace tweenfall::soft
