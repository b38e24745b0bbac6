// The carrier's INS: the truth with the errors of a navigation system.
#pragma once

#include "bench/scenario/schedule.hpp"
#include "bench/sensors/sample_loss.hpp"
#include "bench/world/error_stack.hpp"
#include "bench/world/navigation_errors.hpp"

namespace canhil::sensors {

/// The table [master_ins].
struct MasterInsSettings {
  scenario::Schedule schedule{};
  world::NavigationErrorModel errors{};  ///< white: drawn for each sample
  world::TriadErrors::Stacks further{};  ///< of the velocity, NED
  SampleLoss loss{};
};

extern const struct Kind master_ins;

}  // namespace canhil::sensors
