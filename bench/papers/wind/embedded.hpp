// The files of bench/campaigns/paper_wind, built into the program.
#pragma once

#include "bench/papers/flown.hpp"

namespace canhil::papers::wind {

extern const Campaigns embedded;

}  // namespace canhil::papers::wind
