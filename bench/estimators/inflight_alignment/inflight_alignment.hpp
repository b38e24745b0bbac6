// In-flight alignment with position fixes: a sample is a fix that was used or gated, with the errors of the
// first navigation answer that knew of it.
#pragma once

#include "bench/checks/estimator.hpp"

namespace canhil::estimators {

extern const Estimator inflight_alignment;

}  // namespace canhil::estimators
