// [master_ins]: the carrier's INS, whose velocity the target matches.
#pragma once

#include "bench/scenario/sample_loss.hpp"
#include "bench/scenario/schedule.hpp"
#include "bench/world/navigation_errors.hpp"

namespace canhil::scenario {

class Section;

struct MasterIns {
  Schedule schedule;
  world::NavigationErrorModel errors;  ///< white: drawn anew for each sample
  SampleLoss loss{};
};

MasterIns read_master_ins(Section& section);

}  // namespace canhil::scenario
