// The files of bench/campaigns/paper_los, built into the program.
#pragma once

#include "bench/papers/flown.hpp"

namespace canhil::papers::los_rate {

extern const Campaigns embedded;

}  // namespace canhil::papers::los_rate
