// A schedule in virtual time: as fast as the target answers.
#pragma once

#include <atomic>

#include "bench/drive/ending.hpp"
#include "bench/drive/link.hpp"
#include "bench/drive/real_time.hpp"
#include "bench/drive/schedule.hpp"

namespace canhil::drive {

/// Sends each step's frames; the watch says which closes the step, and when the next may be opened.
/// The frames and their order are those of run_real_time. A step that is not answered within `step_limit_ns`
/// ends the run.
Ending run_lockstep(Link& link, Schedule& schedule, observe::TargetWatch& watch, std::int64_t step_limit_ns,
                    const std::atomic<bool>& stop, const Progress& progress);

}  // namespace canhil::drive
