// What an estimator's folder says of errors beside the sigmas that were told with them.
#pragma once

#include "bench/world/attitude.hpp"

namespace canhil::estimators {

/// The largest of the components' |error|/sigma; NaN if any is no number.
inline double over_sigma(const world::Vector3& error, const world::Vector3& sigma) {
  constexpr double least = 1e-12;  // a sigma of zero and no error are no contradiction
  return (error.array().abs() / sigma.array().max(least)).maxCoeff<Eigen::PropagateNaN>();
}

}  // namespace canhil::estimators
