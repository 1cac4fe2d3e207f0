#pragma once

#include <span>
#include <vector>

namespace tweenfall::strategies {

/// The linear complementarity problem: z and w = A z + q, both nonnegative, and for each row one of the two is 0; by
/// Lemke's pivots. For a positive semidefinite matrix it finds a solution if there is one. It never cycles, since
/// of equal ratios the lexicographically least leaves.
/// @param matrix  A, row by row
/// @param z       written if there is a solution
/// @return whether there is one
/// Source: Cottle, Pang and Stone, The Linear Complementarity Problem, 1992, 4.4 and 4.9.
[[nodiscard]] bool solve_by_lemke(std::span<const double> matrix, std::span<const double> q, std::span<double> z);

}  // namespace tweenfall::strategies
