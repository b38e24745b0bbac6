#pragma once
// Eigenvalues and eigenvectors of symmetric matrices with a size known at run time: compiled once for all
// sizes.
#include "target/estimators/filtering/kalman.hpp"

namespace canhil::filtering {

/// The largest number of rows.
inline constexpr int most_eigen_rows = 18;
using SquareMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_eigen_rows, most_eigen_rows>;
using ColumnVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_eigen_rows, 1>;

/// Eigenvalues and eigenvectors.
struct SymmetricEigen {
  ColumnVector values;   // ascending
  SquareMatrix vectors;  // columns of length 1
};

/// Computes the eigenvalues and eigenvectors of a symmetric matrix with at least 2 rows. Only the lower
/// triangle is read.
SymmetricEigen symmetric_eigen(const SquareMatrix& symmetric);

namespace detail {
double largest_eigenvalue(const SquareMatrix& symmetric);
double largest_eigenvalue_of_3(const Matrix<3, 3>& symmetric);  // one reflection makes the matrix tridiagonal
}  // namespace detail

/// The largest eigenvalue of a symmetric matrix. Iterative: the closed form for 3 x 3 loses half the digits
/// if two eigenvalues are equal, as for an isotropic P.
template <int N>
double largest_eigenvalue(const Matrix<N, N>& symmetric) {
  if constexpr (N == 3) return detail::largest_eigenvalue_of_3(symmetric);
  return detail::largest_eigenvalue(symmetric);
}

}  // namespace canhil::filtering
