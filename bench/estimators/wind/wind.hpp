// Wind velocity of a glider. In a campaign, a sample is an answer of a running filter.
#pragma once

#include "bench/checks/estimator.hpp"

namespace canhil::estimators {

extern const Estimator wind;

}  // namespace canhil::estimators
