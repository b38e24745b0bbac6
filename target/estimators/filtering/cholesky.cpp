#include "target/estimators/filtering/cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace canhil::filtering::detail {
namespace {

using Eigen::Index;

struct Factor {
  const double* P;
  Index N;
  Index stride;  // rows of L: even_rows(N)
};

// Column c of P minus the contribution of the first `done` columns of L. Computes the last `rows` rows, which
// begin at row c or at row c - 1. P is not padded if N is odd.
template <int rows>
Vector<rows> column_left(const Factor& of, const double* L, Index c, Index done) {
  const Index first = of.stride - rows;
  const double* const P = of.P + c * of.N + first;
  Vector<rows> left;
  left.template head<rows - 1>() = Eigen::Map<const Vector<rows - 1>>(P);
  left(rows - 1) = of.N % 2 == 0 ? P[rows - 1] : 0;
  for (Index j = 0; j < done; ++j, L += of.stride)
    left.noalias() -= L[c] * Eigen::Map<const Vector<rows>>(L + first);
  return left;
}

template <int rows>
bool finish_column(const Factor& of, double* L, Index c) {
  const Index first = of.stride - rows;
  const Vector<rows> left = column_left<rows>(of, L, c, c);
  const double pivot = left(c - first);
  if (!(pivot > 0 && pivot <= std::numeric_limits<double>::max())) return false;
  double* const column = L + c * of.stride;
  std::fill_n(column, first, 0.0);
  Eigen::Map<Vector<rows>>(column + first) = left * (1 / std::sqrt(pivot));
  if (c % 2 != 0) column[c - 1] = 0;
  return true;
}

template <int rows>
void store_rest(const Factor& of, const double* L, Index columns, Index c, double* rest) {
  const Index first = of.stride - rows;
  const Vector<rows> left = column_left<rows>(of, L, c, columns);
  std::copy_n(left.data() + (c - first), of.N - c, rest + (c - columns) * (of.N - columns + 1));
}

// Calls apply.operator()<rows>(), where `rows` is the number of rows from row c (or row c - 1) to the last.
template <class Apply>
auto with_rows(const Factor& of, Index c, const Apply& apply) {
  switch (of.stride - (c - c % 2)) {
    case 20:
      return apply.template operator()<20>();
    case 18:
      return apply.template operator()<18>();
    case 16:
      return apply.template operator()<16>();
    case 14:
      return apply.template operator()<14>();
    case 12:
      return apply.template operator()<12>();
    case 10:
      return apply.template operator()<10>();
    case 8:
      return apply.template operator()<8>();
    case 6:
      return apply.template operator()<6>();
    case 4:
      return apply.template operator()<4>();
    default:
      return apply.template operator()<2>();
  }
}

}  // namespace

bool cholesky_columns(const double* P, int N, double* L, int columns) {
  const Factor of{P, N, even_rows(N)};
  for (Index c = 0; c < columns; ++c) {
    if (!with_rows(of, c, [&]<int rows>() { return finish_column<rows>(of, L, c); })) return false;
  }
  return true;
}

void cholesky_rest(const double* P, int N, const double* L, int columns, double* rest) {
  const Factor of{P, N, even_rows(N)};
  for (Index c = columns; c < N; ++c)
    with_rows(of, c, [&]<int rows>() { store_rest<rows>(of, L, columns, c, rest); });
}

}  // namespace canhil::filtering::detail
