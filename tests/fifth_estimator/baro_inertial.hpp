// Baro-inertial height: a sample is an answer to a barometric height.
#pragma once

#include "bench/checks/estimator.hpp"

namespace canhil::estimators {

extern const Estimator baro_inertial;

}  // namespace canhil::estimators
