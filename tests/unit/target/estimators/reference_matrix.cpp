#include "tests/unit/target/estimators/reference_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ostream>
#include <stdexcept>
#include <utility>

#include "tests/unit/target/estimators/random_matrix.hpp"

namespace canhil {
namespace {

template <class Function>
Dense each(const Dense& m, const Function& function) {
  Dense out = m;
  for (double& value : out.by_columns()) value = function(value);
  return out;
}

template <class Function>
Dense both(const Dense& a, const Dense& b, const Function& function) {
  if (a.rows() != b.rows() || a.columns() != b.columns()) throw std::invalid_argument("sizes differ");
  Dense out = a;
  for (std::size_t i = 0; i < out.by_columns().size(); ++i)
    out.by_columns()[i] = function(a.by_columns()[i], b.by_columns()[i]);
  return out;
}

// Returns the determinant of `m`. Gauss-Jordan elimination with row pivots turns m into I and `right` into
// m^-1 right.
double eliminate(Dense m, Dense& right) {
  double determinant = 1;
  for (int k = 0; k < m.rows(); ++k) {
    int pivot = k;
    for (int i = k + 1; i < m.rows(); ++i)
      if (std::abs(m(i, k)) > std::abs(m(pivot, k))) pivot = i;
    if (pivot != k) determinant = -determinant;
    const double scale = m(pivot, k);
    determinant *= scale;
    for (Dense* side : {&m, &right}) {
      for (int j = 0; j < side->columns(); ++j) {
        std::swap((*side)(k, j), (*side)(pivot, j));
        (*side)(k, j) /= scale;
      }
    }
    for (int i = 0; i < m.rows(); ++i) {
      const double factor = m(i, k);
      if (i == k) continue;
      for (int j = 0; j < m.columns(); ++j) m(i, j) -= factor * m(k, j);
      for (int j = 0; j < right.columns(); ++j) right(i, j) -= factor * right(k, j);
    }
  }
  return determinant;
}

}  // namespace

Dense::Dense(int rows, int columns)
    : rows_(rows),
      columns_(columns),
      values_(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns)) {}

Dense::Dense(const double* by_columns, int rows, int columns) : Dense(rows, columns) {
  values_.assign(by_columns, by_columns + values_.size());
}

const double* Dense::entries_of(int rows, int columns) const {
  if (rows != rows_ || columns != columns_) throw std::invalid_argument("not of this size");
  return values_.data();
}

Dense Dense::block(int row, int column, int rows, int columns) const {
  if (row + rows > rows_ || column + columns > columns_) throw std::out_of_range("block");
  Dense out(rows, columns);
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) out(i, j) = (*this)(row + i, column + j);
  return out;
}

Dense& Dense::set(int row, int column, const Dense& part) {
  if (row + part.rows() > rows_ || column + part.columns() > columns_) throw std::out_of_range("set");
  for (int j = 0; j < part.columns(); ++j)
    for (int i = 0; i < part.rows(); ++i) (*this)(row + i, column + j) = part(i, j);
  return *this;
}

Dense identity(int size) {
  Dense out(size, size);
  for (int i = 0; i < size; ++i) out(i, i) = 1;
  return out;
}

Dense diagonal_matrix(const Dense& diagonal) {
  const int size = static_cast<int>(diagonal.by_columns().size());
  Dense out(size, size);
  for (int i = 0; i < size; ++i) out(i, i) = diagonal.by_columns()[static_cast<std::size_t>(i)];
  return out;
}

Dense diagonal(const Dense& square) {
  Dense out(square.rows(), 1);
  for (int i = 0; i < square.rows(); ++i) out(i, 0) = square(i, i);
  return out;
}

Dense transposed(const Dense& m) {
  Dense out(m.columns(), m.rows());
  for (int j = 0; j < m.columns(); ++j)
    for (int i = 0; i < m.rows(); ++i) out(j, i) = m(i, j);
  return out;
}

Dense inverse(const Dense& m) {
  Dense out = identity(m.rows());
  eliminate(m, out);
  return out;
}

double determinant(const Dense& m) {
  Dense nothing(m.rows(), 0);
  return eliminate(m, nothing);
}

Dense operator+(const Dense& a, const Dense& b) {
  return both(a, b, [](double x, double y) { return x + y; });
}
Dense operator-(const Dense& a, const Dense& b) {
  return both(a, b, [](double x, double y) { return x - y; });
}
Dense operator*(const Dense& a, const Dense& b) {
  if (a.columns() != b.rows()) throw std::invalid_argument("sizes do not fit a product");
  Dense out(a.rows(), b.columns());
  for (int j = 0; j < b.columns(); ++j)
    for (int k = 0; k < a.columns(); ++k)
      for (int i = 0; i < a.rows(); ++i) out(i, j) += a(i, k) * b(k, j);
  return out;
}
Dense operator*(double factor, const Dense& m) {
  return each(m, [&](double x) { return factor * x; });
}
Dense operator/(const Dense& m, double divisor) {
  return each(m, [&](double x) { return x / divisor; });
}
bool operator==(const Dense& a, const Dense& b) {
  return a.rows() == b.rows() && a.columns() == b.columns() && a.by_columns() == b.by_columns();
}
std::ostream& operator<<(std::ostream& out, const Dense& m) {
  for (int i = 0; i < m.rows(); ++i) {
    out << '\n';
    for (int j = 0; j < m.columns(); ++j) out << m(i, j) << ' ';
  }
  return out;
}

double dot(const Dense& a, const Dense& b) {
  const Dense products = both(a, b, [](double x, double y) { return x * y; });
  return std::accumulate(products.by_columns().begin(), products.by_columns().end(), 0.0);
}
double norm(const Dense& m) { return std::sqrt(dot(m, m)); }
double largest(const Dense& m) {
  double most = 0;
  for (const double value : m.by_columns()) {
    if (std::isnan(value)) return value;
    most = std::max(most, std::abs(value));
  }
  return most;
}

Dense entrywise_sizes(const Dense& m) {
  return each(m, [](double x) { return std::abs(x); });
}
Dense entrywise_roots(const Dense& m) {
  return each(m, [](double x) { return std::sqrt(x); });
}
Dense entrywise_quotient(const Dense& a, const Dense& b) {
  return both(a, b, [](double x, double y) { return x / y; });
}

Dense lower_cholesky(const Dense& m) {
  Dense L(m.rows(), m.rows());
  for (int k = 0; k < m.rows(); ++k) {
    for (int i = k; i < m.rows(); ++i) {
      double rest = m(i, k);
      for (int j = 0; j < k; ++j) rest -= L(i, j) * L(k, j);
      L(i, k) = i == k ? std::sqrt(rest) : rest / L(k, k);
    }
  }
  return L;
}

Dense matrix_exponential(const Dense& m) {
  const auto size = static_cast<std::size_t>(m.rows());
  std::vector<long double> term(size * size), sum(size * size);
  for (std::size_t i = 0; i < size; ++i) term[i * size + i] = sum[i * size + i] = 1;
  for (int n = 1; n <= 80; ++n) {
    std::vector<long double> next(size * size);
    for (std::size_t j = 0; j < size; ++j)
      for (std::size_t k = 0; k < size; ++k)
        for (std::size_t i = 0; i < size; ++i)
          next[j * size + i] += term[k * size + i] * m.by_columns()[j * size + k] / n;
    term = next;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += term[i];
  }
  Dense out = m;
  std::ranges::transform(sum, out.by_columns().begin(),
                         [](long double value) { return static_cast<double>(value); });
  return out;
}

Dense random_dense(int rows, int columns, std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  Dense out(rows, columns);
  for (double& value : out.by_columns()) value = normal(engine);
  return out;
}

Dense random_covariance_dense(int size, std::mt19937_64& engine) {
  const Dense root = random_dense(size, size, engine);
  return identity(size) + root * transposed(root);
}

}  // namespace canhil
