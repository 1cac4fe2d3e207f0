#pragma once

#include <span>
#include <vector>

namespace tweenfall::strategies {

/// The linear complementarity problem: z and w = A z + q with none negative and, one by one, one of the two 0; by
/// Lemke's pivots. Of a matrix that is positive semidefinite it finds a solution where there is one; the same ones are
/// met again by none, for of equal ratios the lexicographically least leaves.
/// @param matrix  A, row by row
/// @param z       written when there is a solution
/// @return whether there is
/// Source: Cottle, Pang and Stone, The Linear Complementarity Problem, 1992, 4.4 and 4.9.
[[nodiscard]] bool solve_by_lemke(std::span<const double> matrix, std::span<const double> q, std::span<double> z);

}  // namespace tweenfall::strategies
