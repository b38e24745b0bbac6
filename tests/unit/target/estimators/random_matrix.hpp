#pragma once
// Random matrices for tests, reproducible from a seed. Eigen's Random() uses the generator of the C library,
// whose sequence a seed does not determine.
#include <random>

#include "tests/unit/target/estimators/reference_matrix.hpp"

namespace canhil {

/// A matrix of standard normal numbers, filled by columns.
Dense random_dense(int rows, int columns, std::mt19937_64& engine);
/// A symmetric matrix whose smallest eigenvalue is at least 1.
Dense random_covariance_dense(int size, std::mt19937_64& engine);

template <int Rows, int Cols>
Eigen::Matrix<double, Rows, Cols> random_matrix(std::mt19937_64& engine) {
  return random_dense(Rows, Cols, engine).fixed<Rows, Cols>();
}

template <int N>
Eigen::Matrix<double, N, N> random_covariance(std::mt19937_64& engine) {
  return random_covariance_dense(N, engine).fixed<N, N>();
}

}  // namespace canhil
