#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tweenfall::strategies {

/// The linear complementarity problem of a positive definite matrix: z and w = A z + q, both nonnegative, and for each
/// row one of the two is 0. All rows on the wrong side change it at once, and only if that leads nowhere, the
/// last of them alone: this takes a few factorizations, while Lemke's method takes as many pivots as rows.
/// Source: Judice, Pires, A Block Principal Pivoting Algorithm for Large-Scale Strictly Monotone Linear Complementarity
/// Problems, Computers & Operations Research 21, 1994.
class BlockPivots {
 public:
  /// @param matrix  A, row by row; symmetric
  /// @param slack   by row: amounts below this count as 0
  BlockPivots(std::span<const double> matrix, std::span<const double> slack);

  /// @param z  a guess, and then the solution: rows above 0 are tried first
  /// @return whether it was solved within rounding
  [[nodiscard]] bool solve(std::span<const double> q, std::span<double> z);
  /// How z must change so that what rows above 0 still part by goes. @return whether they can be solved for
  [[nodiscard]] bool correct(std::span<const double> parting, std::span<const double> z, std::span<double> change);

 private:
  void solve_factored();
  [[nodiscard]] bool factor();
  void find(std::span<const double> q);

  std::size_t count_;
  std::span<const double> matrix_, slack_;
  std::vector<char> pressing_, factored_;  ///< by row; those in the factor
  std::vector<std::uint32_t> rows_;        ///< that press
  std::vector<double> factor_;             ///< of the pressing rows and columns, as L D L'
  std::vector<double> values_, parting_, left_;
};

}  // namespace tweenfall::strategies
