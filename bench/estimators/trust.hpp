// Errors compared with the reported sigmas.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

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

}  // namespace canhil::estimators
