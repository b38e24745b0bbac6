// The estimator of baro-inertial height: the target answers each barometric height with one estimate.
#pragma once

#include "bench/checks/estimator.hpp"

namespace canhil::estimators {

extern const Estimator baro_inertial;

}  // namespace canhil::estimators
