// Errors compared with the reported sigmas.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/quantities/list.hpp"
#include "bench/quantities/samples.hpp"
#include "bench/world/attitude.hpp"

namespace canhil::estimators {

/// |error|/sigma; infinite if one of the two is not a number or infinite.
inline double over_sigma(double error, double sigma) {
  constexpr double least = 1e-12;  // zero error with zero sigma is consistent
  if (!std::isfinite(error) || !std::isfinite(sigma)) return std::numeric_limits<double>::infinity();
  return std::abs(error) / std::max(sigma, least);
}

/// The largest |error|/sigma of the components.
inline double over_sigma(const world::Vector3& error, const world::Vector3& sigma) {
  return std::max(
      {over_sigma(error.x(), sigma.x()), over_sigma(error.y(), sigma.y()), over_sigma(error.z(), sigma.z())});
}

/// trusted.over_sigma of a sample that is one answer.
inline double over_sigma_if_trusted(const quantities::Samples& samples, std::size_t index) {
  const bool trusted = samples.value(index, quantities::degraded) == 0;
  return trusted ? samples.value(index, quantities::error_over_sigma) : 0;
}
inline constexpr quantities::Derived derived_trust{.quantity = &quantities::trusted_over_sigma,
                                                   .of = over_sigma_if_trusted};

}  // namespace canhil::estimators
