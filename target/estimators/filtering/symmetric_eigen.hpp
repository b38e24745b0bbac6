#pragma once
// Eigenvalues and eigenvectors of symmetric matrices, of a size known at run time: compiled once for all of
// them.
#include "target/estimators/filtering/kalman.hpp"

namespace canhil::filtering {

inline constexpr int most_eigen_rows = 18;
using SquareMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_eigen_rows, most_eigen_rows>;
using ColumnVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_eigen_rows, 1>;

struct SymmetricEigen {
  ColumnVector values;   // rising
  SquareMatrix vectors;  // columns, of length 1
};

/// Of a symmetric matrix (lower triangle read) of 2 rows or more.
SymmetricEigen symmetric_eigen(const SquareMatrix& symmetric);

namespace detail {
double largest_eigenvalue(const SquareMatrix& symmetric);
double largest_eigenvalue_of_3(const Matrix<3, 3>& symmetric);  // which Eigen makes tridiagonal in one step
}  // namespace detail

/// The largest eigenvalue of a symmetric matrix (iterative: the closed form of 3 x 3 loses half the digits
/// where two eigenvalues meet, as they do for an isotropic P).
template <int N>
double largest_eigenvalue(const Matrix<N, N>& symmetric) {
  if constexpr (N == 3) return detail::largest_eigenvalue_of_3(symmetric);
  return detail::largest_eigenvalue(symmetric);
}

}  // namespace canhil::filtering
