#pragma once
// Seeded matrices for tests: Eigen's Random() draws from the C library's generator, which a seed does not pin
// down.
#include <Eigen/Core>
#include <random>

namespace canhil {

template <int Rows, int Cols>
Eigen::Matrix<double, Rows, Cols> random_matrix(std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  Eigen::Matrix<double, Rows, Cols> m;
  for (int column = 0; column < Cols; ++column)
    for (int row = 0; row < Rows; ++row) m(row, column) = normal(engine);
  return m;
}

/// Symmetric, smallest eigenvalue at least 1.
template <int N>
Eigen::Matrix<double, N, N> random_covariance(std::mt19937_64& engine) {
  const Eigen::Matrix<double, N, N> root = random_matrix<N, N>(engine);
  return Eigen::Matrix<double, N, N>::Identity() + root * root.transpose();
}

}  // namespace canhil
