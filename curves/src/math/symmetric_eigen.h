#pragma once

// Eigenvalues and eigenvectors of a symmetric matrix of four rows, with the same bits everywhere.

#include <Eigen/Core>

namespace tweenfall::math {

using Mat4 = Eigen::Matrix<double, 4, 4, Eigen::DontAlign>;

struct SymmetricEigen {
  Eigen::Matrix<double, 4, 1, Eigen::DontAlign> values;  ///< largest first
  Mat4 vectors;                                          ///< columns, of unit length, in the order of the values
};

/// Source: Golub and Van Loan, "Matrix Computations", 8.5 (cyclic Jacobi).
[[nodiscard]] SymmetricEigen symmetric_eigen(const Mat4& matrix) noexcept;

}  // namespace tweenfall::math
