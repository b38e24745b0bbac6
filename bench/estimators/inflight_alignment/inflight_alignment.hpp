// In-flight alignment with position fixes. In a campaign, each sample belongs to a fix that was used or
// gated, and contains the errors of the first navigation answer after the update by this fix.
#pragma once

#include "bench/checks/estimator.hpp"

namespace canhil::estimators {

extern const Estimator inflight_alignment;

}  // namespace canhil::estimators
