// Runs a schedule in virtual time: as fast as the target answers.
#pragma once

#include <atomic>

#include "bench/drive/ending.hpp"
#include "bench/drive/link.hpp"
#include "bench/drive/real_time.hpp"
#include "bench/drive/schedule.hpp"

namespace canhil::drive {

/// Sends the frames of each step; the watch decides which frame closes the step and when the next step may
/// begin. The frames and their order are the same as in run_real_time(). The run ends early if the target
/// does not answer a step within `step_limit_ns`, if `gone` returns a reason, or if `stop` is set.
Ending run_lockstep(Link& link, Schedule& schedule, observe::TargetWatch& watch, std::int64_t step_limit_ns,
                    const std::atomic<bool>& stop, const Progress& progress, const Gone& gone = never_gone);

}  // namespace canhil::drive
