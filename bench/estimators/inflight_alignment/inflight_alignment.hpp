// In-flight alignment with position fixes: a sample is a used or gated fix, with the errors of the first
// navigation answer that includes it.
#pragma once

#include "bench/checks/estimator.hpp"

namespace canhil::estimators {

extern const Estimator inflight_alignment;

}  // namespace canhil::estimators
