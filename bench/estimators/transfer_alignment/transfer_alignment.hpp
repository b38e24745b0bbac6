// Transfer alignment of a slave INS to a master INS by velocity matching. In a campaign, each sample belongs
// to a velocity update, and contains the errors of the first navigation answer after this update.
#pragma once

#include "bench/checks/estimator.hpp"

namespace canhil::estimators {

extern const Estimator transfer_alignment;

}  // namespace canhil::estimators
