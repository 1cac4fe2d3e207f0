#pragma once

#include <cstdint>
#include <vector>

#include "actors/soft/soft_state.h"

namespace tweenfall::soft {

/// Edges one after the other.
struct Chain {
  std::vector<std::uint32_t> edges;
  std::vector<std::uint32_t> nodes;  ///< one more than edges: each edge is between its own and the next
};

/// All edges that are not torn, in chains from end to end; a ring is opened at an edge, which is a chain of its own.
/// None where a node has more than two edges.
[[nodiscard]] std::vector<Chain> chains_of(const SoftBody& body);

/// Solves a symmetric system of three diagonals, which is not indefinite: values become its solution.
/// @param diagonal  becomes its pivots @param beside  of each with the one before it; the first is not read
/// Source: Golub, Van Loan, Matrix Computations, 4th edition, 2013, 4.3.6.
void solve_three_diagonals(std::vector<double>& diagonal, const std::vector<double>& beside,
                           std::vector<double>& values);

}  // namespace tweenfall::soft
