// The files of bench/campaigns/paper_transfer, built into the program.
#pragma once

#include "bench/papers/flown.hpp"

namespace canhil::papers::transfer_alignment {

extern const Campaigns embedded;

}  // namespace canhil::papers::transfer_alignment
