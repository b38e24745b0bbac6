// What the bench's own machine did to a run.
#pragma once

#include <cstdint>

namespace canhil::checks {

struct HostRecord {
  std::int64_t clock_step_ns =
      0;                        ///< the largest step of the clock of the stamps; 0: none, or it cannot step
  double wall_s = 0;            ///< over which the rest was counted
  double cpu_run_s = 0;         ///< of the bench
  double cpu_wait_s = 0;        ///< the bench was ready to run, and others held the CPU
  double stolen_share = 0;      ///< of the CPUs' time that the hypervisor gave to others
  std::uint64_t preempted = 0;  ///< the bench lost the CPU before it was done
};

}  // namespace canhil::checks
