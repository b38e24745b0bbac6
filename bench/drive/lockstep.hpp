// Runs a schedule in virtual time: as fast as the target answers.
#pragma once

#include <atomic>

#include "bench/drive/ending.hpp"
#include "bench/drive/link.hpp"
#include "bench/drive/real_time.hpp"
#include "bench/drive/schedule.hpp"

namespace canhil::drive {

/// Sends the frames of each step; the watch decides which frame closes the step and when the next step may
/// begin. Frames and their order are the same as in run_real_time. A step without an answer within
/// `step_limit_ns` ends the run.
Ending run_lockstep(Link& link, Schedule& schedule, observe::TargetWatch& watch, std::int64_t step_limit_ns,
                    const std::atomic<bool>& stop, const Progress& progress);

}  // namespace canhil::drive
