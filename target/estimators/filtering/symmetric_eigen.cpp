#include "target/estimators/filtering/symmetric_eigen.hpp"

#include <Eigen/Eigenvalues>

namespace canhil::filtering {
namespace {

// Tridiagonal form of a symmetric A: A / scale = Q T Q'. The scale limits the elements to +-1, which avoids
// overflow and underflow.
struct Tridiagonal {
  double scale;
  SquareMatrix packed;  // T's diagonals; below them the reflections whose product is Q
  ColumnVector storage;

  explicit Tridiagonal(const SquareMatrix& symmetric)
      : scale(largest_element(symmetric)), packed(symmetric / scale), storage(symmetric.rows()) {
    auto h = coefficients();
    Eigen::internal::tridiagonalization_inplace(packed, h);
  }

  // The coefficients of the reflections. Eigen sums in an order that depends on whether the address of the
  // result is a multiple of 16 bytes. Here the address has the same alignment as in a fixed-size
  // SelfAdjointEigenSolver, so that the sums have the same bits too.
  Eigen::VectorBlock<ColumnVector> coefficients() {
    const Eigen::Index n = packed.rows();
    return storage.segment((n + 1) % 2, n - 1);
  }

  static double largest_element(const SquareMatrix& symmetric) {
    const double largest = SquareMatrix(symmetric.triangularView<Eigen::Lower>()).cwiseAbs().maxCoeff();
    return largest == 0 ? 1 : largest;
  }

  SquareMatrix Q() {
    const Eigen::Index n = packed.rows();
    SquareMatrix product = SquareMatrix::Identity(n, n);
    ColumnVector workspace(n);
    for (Eigen::Index k = n - 2; k >= 0; --k) {
      const Eigen::Index rows = n - k - 1;
      product.bottomRightCorner(rows, rows)
          .applyHouseholderOnTheLeft(packed.col(k).tail(rows - 1), coefficients()(k), workspace.data());
    }
    return product;
  }
};

}  // namespace

// The steps of Eigen::SelfAdjointEigenSolver, with bit-identical results. Eigen's solver would also
// instantiate block reflections for more than 48 rows; their compilation takes far longer than that of
// everything else here.
SymmetricEigen symmetric_eigen(const SquareMatrix& symmetric) {
  using Solver = Eigen::SelfAdjointEigenSolver<SquareMatrix>;
  Tridiagonal T(symmetric);
  SymmetricEigen eigen{T.packed.diagonal(), T.Q()};
  ColumnVector subdiagonal = T.packed.diagonal<-1>();
  Eigen::internal::computeFromTridiagonal_impl(eigen.values, subdiagonal, Solver::m_maxIterations, true,
                                               eigen.vectors);
  eigen.values *= T.scale;
  return eigen;
}

namespace detail {

double largest_eigenvalue(const SquareMatrix& symmetric) {
  const Tridiagonal T(symmetric);
  Eigen::SelfAdjointEigenSolver<SquareMatrix> solver(symmetric.rows());
  solver.computeFromTridiagonal(T.packed.diagonal(), T.packed.diagonal<-1>(), Eigen::EigenvaluesOnly);
  return T.scale * solver.eigenvalues()(symmetric.rows() - 1);
}

double largest_eigenvalue_of_3(const Matrix<3, 3>& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Matrix<3, 3>> solver(symmetric, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(2);
}

}  // namespace detail
}  // namespace canhil::filtering
