#pragma once

/// Eigenvalues and eigenvectors of small symmetric matrices, with the same bits everywhere: for principal axes of
/// bodies, directions in which points are spread, the mean of rotations.

#include <Eigen/Core>

namespace tweenfall {

template <int rows>
struct SymmetricEigen {
  Eigen::Matrix<double, rows, 1, Eigen::DontAlign> values;      ///< largest first
  Eigen::Matrix<double, rows, rows, Eigen::DontAlign> vectors;  ///< columns, of unit length, in the order of the values
};

/// For a matrix of three or four rows; what is below its diagonal is assumed to equal what is above.
/// Source: Golub and Van Loan, "Matrix Computations", 8.5 (cyclic Jacobi).
[[nodiscard]] SymmetricEigen<3> symmetric_eigen(const Eigen::Matrix<double, 3, 3, Eigen::DontAlign>& matrix) noexcept;
[[nodiscard]] SymmetricEigen<4> symmetric_eigen(const Eigen::Matrix<double, 4, 4, Eigen::DontAlign>& matrix) noexcept;

}  // namespace tweenfall
