// Line-of-sight rate of a seeker. In a campaign, a sample summarises the answers in 20 ms of the time to go.
#pragma once

#include "bench/checks/estimator.hpp"

namespace canhil::estimators {

extern const Estimator los_rate;

}  // namespace canhil::estimators
