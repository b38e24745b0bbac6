// How the bench's own machine affected a run.
#pragma once

#include <chrono>
#include <cstdint>

#include "bench/checks/histogram.hpp"

namespace canhil::checks {

/// How the host delayed a target that the bench started on it. Empty: unknown.
struct TargetDelays {
  /// The length of the parts of a run that `waits` counts.
  static constexpr std::chrono::milliseconds part{10};
  Histogram waits{};   ///< time in which the target was ready to run but other programs held the CPU, in each
                       ///< part of the run
  Histogram stalls{};  ///< delays of a thread of high priority on the target's CPUs, see
                       ///< observe::CpuStalls
};

struct HostRecord {
  std::int64_t clock_step_ns = 0;  ///< largest step of the clock that stamps frames; 0: no step, or a clock
                                   ///< that cannot step
  double wall_s = 0;               ///< length of the interval that the values below cover
  double cpu_run_s = 0;            ///< time in which the bench ran
  double cpu_wait_s = 0;    ///< time in which the bench was ready to run but other programs held the CPU
  double stolen_share = 0;  ///< fraction of the CPUs' time that the hypervisor gave to other guests
  bool may_be_realtime =
      false;  ///< the bench has no real-time scheduling, so its option --realtime would help
  std::uint64_t preempted = 0;  ///< how often the bench lost the CPU although it had more to do
};

}  // namespace canhil::checks
