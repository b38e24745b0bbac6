#pragma once
// What the recommended filter does if fixes differ from its predictions by more than its covariance says: it
// widens the covariance until it covers the difference.
#include <algorithm>
#include <limits>
#include <span>

#include "target/estimators/inflight_alignment/filter.hpp"
#include "target/estimators/inflight_alignment/fix_error.hpp"

namespace canhil::inflight_alignment {

/// True if a fix with this NIS is an outlier, or the first one after a jump. Once a fix was refused, the
/// recommended filter halves the limit, because its covariance grows while it waits: otherwise it would
/// take a jump for an error of its velocity.
inline bool is_doubted(double nis, std::uint32_t rejected, const Settings& settings) {
  constexpr double surely = 40;  // chi-squared with 3 degrees of freedom exceeds it once in 1e8
  const bool modelled = models_fix_errors(settings);
  double limit = settings.gate_nis > 0 ? settings.gate_nis
                 : modelled            ? surely
                                       : std::numeric_limits<double>::infinity();
  if (modelled && rejected > 0) limit /= 2;
  return nis > limit;
}

/// Widens the covariance of position and fix bias by `offset` [m], by which fixes and filter differ: nobody
/// knows which of them errs. If the offset grew over `duration` [s], it may be an error of the velocity, too.
template <int N>
void widen(Errors<N>& errors, FixErrors& fixes, const Eigen::Vector3d& offset, double duration) {
  using At = Layout<N>;
  const Eigen::Vector3d square = offset.cwiseAbs2();
  auto variances = errors.P.diagonal();
  variances.template segment<3>(At::position) += square;
  if (duration > 0) variances.template segment<3>(At::velocity) += square / (duration * duration);
  if constexpr (At::has_fix_bias) variances.template segment<3>(At::fix_bias) += square;
  fixes.seen += square;
  fixes.charts.restart();
}

/// Adds the innovation of a fix, with the covariance S, to the charts. If they show a lasting mean, widens
/// the covariance by twice the mean, because the filter has absorbed about as much; returns true then.
template <int N>
bool watch(Errors<N>& errors, FixErrors& fixes, const Eigen::Vector3d& innovation, const Eigen::Matrix3d& S) {
  const Eigen::Vector3d sigma = S.diagonal().cwiseSqrt();
  const Eigen::Vector3d normalised = innovation.cwiseQuotient(sigma);
  if (!fixes.charts.are_beyond(std::span<const double, 3>(normalised.data(), 3))) return false;
  Eigen::Vector3d offset;
  int memory = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto mean = fixes.charts.mean(static_cast<std::size_t>(axis));
    offset(axis) = 2 * mean.value * sigma(axis);
    memory = std::max(memory, mean.memory);
  }
  widen<N>(errors, fixes, offset, fixes.age * memory);
  return true;
}

}  // namespace canhil::inflight_alignment
