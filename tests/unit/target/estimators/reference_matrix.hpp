#pragma once
// Matrices of any size for references in tests. Class Dense is compiled once, in reference_matrix.cpp. With
// fixed-size Eigen matrices, each expression has a separate type, and one test took longer to compile than
// the filter.
#include <Eigen/Core>
#include <iosfwd>
#include <vector>

namespace canhil {

class Dense {
 public:
  Dense(int rows, int columns);  // zeros
  Dense(const double* by_columns, int rows, int columns);

  /// A copy of an Eigen matrix; implicit, so that one expression can mix a filter's matrix with a reference.
  template <int Rows, int Columns, int Options>
  Dense(const Eigen::Matrix<double, Rows, Columns, Options>& m)
      : Dense(m.data(), static_cast<int>(m.rows()), static_cast<int>(m.cols())) {
    static_assert(Rows == 1 || Columns == 1 || Options % 2 == Eigen::ColMajor);
  }

  template <int Rows, int Columns>
  Eigen::Matrix<double, Rows, Columns> fixed() const {
    return Eigen::Matrix<double, Rows, Columns>(entries_of(Rows, Columns));
  }

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  double& operator()(int row, int column) { return values_[index(row, column)]; }
  double operator()(int row, int column) const { return values_[index(row, column)]; }
  const std::vector<double>& by_columns() const { return values_; }
  std::vector<double>& by_columns() { return values_; }

  Dense block(int row, int column, int rows, int columns) const;
  Dense column(int at) const { return block(0, at, rows_, 1); }
  Dense row(int at) const { return block(at, 0, 1, columns_); }
  /// Writes `part` with its upper left corner at (row, column).
  Dense& set(int row, int column, const Dense& part);

 private:
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(column) * static_cast<std::size_t>(rows_) + static_cast<std::size_t>(row);
  }
  const double* entries_of(int rows, int columns) const;  // throws if the size differs

  int rows_, columns_;
  std::vector<double> values_;
};

Dense identity(int size);
Dense diagonal_matrix(const Dense& diagonal);
Dense diagonal(const Dense& square);
Dense transposed(const Dense& m);
Dense inverse(const Dense& m);
Dense operator+(const Dense& a, const Dense& b);
Dense operator-(const Dense& a, const Dense& b);
Dense operator*(const Dense& a, const Dense& b);
Dense operator*(double factor, const Dense& m);
Dense operator/(const Dense& m, double divisor);
bool operator==(const Dense& a, const Dense& b);
std::ostream& operator<<(std::ostream& out, const Dense& m);

double dot(const Dense& a, const Dense& b);
/// norm() is the root of the sum of squares of all entries; largest() is the largest magnitude of an entry.
double norm(const Dense& m);
double largest(const Dense& m);
inline double largest_difference(const Dense& a, const Dense& b) { return largest(a - b); }
Dense entrywise_sizes(const Dense& m);
Dense entrywise_roots(const Dense& m);
Dense entrywise_quotient(const Dense& a, const Dense& b);

/// Eigenvalues of a symmetric matrix by Jacobi's rotations, the smallest first.
std::vector<double> symmetric_eigenvalues(const Dense& m);
/// The largest singular value.
double largest_stretch(const Dense& m);
/// The largest magnitude of an eigenvalue, for any square matrix.
double spectral_radius(const Dense& m);
double determinant(const Dense& m);
/// The matrix L with m = L L'. The upper triangle of L is zero.
Dense lower_cholesky(const Dense& m);
/// The matrix exponential by its power series in extended precision, for matrices of size up to about 10.
Dense matrix_exponential(const Dense& m);

}  // namespace canhil
