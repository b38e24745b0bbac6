#include <algorithm>
#include <cmath>

#include "tests/unit/target/estimators/reference_matrix.hpp"

namespace canhil {
namespace {

// J' m J with the rotation J that makes m(p, q) zero.
void rotate(Dense& m, int p, int q) {
  if (m(p, q) == 0) return;
  const double theta = (m(q, q) - m(p, p)) / (2 * m(p, q));
  const double t = std::copysign(1 / (std::abs(theta) + std::hypot(theta, 1)), theta);
  const double c = 1 / std::hypot(t, 1), s = t * c;
  for (int i = 0; i < m.rows(); ++i) {
    const double at_p = m(i, p), at_q = m(i, q);
    m(i, p) = c * at_p - s * at_q;
    m(i, q) = s * at_p + c * at_q;
  }
  for (int j = 0; j < m.columns(); ++j) {
    const double at_p = m(p, j), at_q = m(q, j);
    m(p, j) = c * at_p - s * at_q;
    m(q, j) = s * at_p + c * at_q;
  }
  m(p, q) = m(q, p) = 0;
}

}  // namespace

std::vector<double> symmetric_eigenvalues(const Dense& m) {
  Dense rotated = m;
  // Convergence is quadratic: after about six sweeps, no rotation changes the matrix.
  for (int sweep = 0; sweep < 15; ++sweep)
    for (int p = 0; p < m.rows(); ++p)
      for (int q = p + 1; q < m.rows(); ++q) rotate(rotated, p, q);
  std::vector<double> values = diagonal(rotated).by_columns();
  std::ranges::sort(values);
  return values;
}

double largest_stretch(const Dense& m) { return std::sqrt(symmetric_eigenvalues(transposed(m) * m).back()); }

// Gelfand's formula: the limit of |m^n|^(1/n), with n doubled at each step.
double spectral_radius(const Dense& m) {
  Dense power = m;
  double logarithm = 0;  // of the extracted scales, per factor m
  double share = 1;
  for (int doubling = 0; doubling < 50; ++doubling) {
    const double size = norm(power);
    if (size == 0) return 0;
    logarithm += share * std::log(size);
    power = power / size;
    power = power * power;
    share /= 2;
  }
  return std::exp(logarithm);
}

}  // namespace canhil
