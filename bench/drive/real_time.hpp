// A schedule against the host's clock.
#pragma once

#include <atomic>
#include <functional>

#include "bench/drive/ending.hpp"
#include "bench/drive/link.hpp"
#include "bench/drive/schedule.hpp"
#include "bench/observe/target_watch.hpp"

namespace canhil::drive {

/// What a run tells while it goes on: bench time [us].
using Progress = std::function<void(std::int64_t t_us)>;

/// Transmits a schedule at absolute deadlines on CLOCK_MONOTONIC until it is exhausted, then waits for the
/// last answers. Ends early when the target stays silent for `silence_limit_ns`, when the bus goes down, or
/// when `stop` is set. For the last `spin_ns` before a deadline it polls instead of sleeping: a wake-up costs
/// no time then, and a CPU works.
Ending run_real_time(Link& link, Schedule& schedule, observe::TargetWatch& watch,
                     std::int64_t silence_limit_ns, const std::atomic<bool>& stop, const Progress& progress,
                     std::int64_t spin_ns = 0);

}  // namespace canhil::drive
