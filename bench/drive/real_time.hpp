// Runs a schedule by the host's clock.
#pragma once

#include <atomic>
#include <functional>

#include "bench/drive/ending.hpp"
#include "bench/drive/link.hpp"
#include "bench/drive/schedule.hpp"
#include "bench/observe/target_watch.hpp"

namespace canhil::drive {

/// Reports the progress of a run: bench time [us].
using Progress = std::function<void(std::int64_t t_us)>;

/// Transmits the frames of a schedule at absolute deadlines on CLOCK_MONOTONIC until the schedule is
/// exhausted, then waits for the last answers. Ends early if the target is silent for `silence_limit_ns`, if
/// the bus goes down, if `gone` returns a reason, or if `stop` is set. During the last `spin_ns` before a
/// deadline, run_real_time() polls instead of sleeping: polling avoids the wake-up delay but keeps a CPU
/// busy.
Ending run_real_time(Link& link, Schedule& schedule, observe::TargetWatch& watch,
                     std::int64_t silence_limit_ns, const std::atomic<bool>& stop, const Progress& progress,
                     std::int64_t spin_ns = 0, const Gone& gone = never_gone);

}  // namespace canhil::drive
