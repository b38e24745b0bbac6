// Errors compared with the reported sigmas.
#pragma once

#include "bench/world/attitude.hpp"

namespace canhil::estimators {

/// The largest |error|/sigma of the components; NaN if any of them is NaN.
inline double over_sigma(const world::Vector3& error, const world::Vector3& sigma) {
  constexpr double least = 1e-12;  // zero error with zero sigma is consistent
  return (error.array().abs() / sigma.array().max(least)).maxCoeff<Eigen::PropagateNaN>();
}

}  // namespace canhil::estimators
