// The files of bench/campaigns/paper_inflight, built into the program.
#pragma once

#include "bench/papers/flown.hpp"

namespace canhil::papers::inflight_alignment {

extern const Campaigns embedded;

}  // namespace canhil::papers::inflight_alignment
