// Line-of-sight rate of a seeker. For a campaign, the time to go is divided into stretches of 20 ms, and each
// sample summarises the answers of one stretch.
#pragma once

#include "bench/checks/estimator.hpp"

namespace canhil::estimators {

extern const Estimator los_rate;

}  // namespace canhil::estimators
