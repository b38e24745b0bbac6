// A real-time process: real-time scheduling, locked memory, a CPU of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::realtime {

/// The default is below 50, which is the priority of interrupt threads under PREEMPT_RT. The thread that
/// empties the CAN controller must run first; otherwise the controller's few buffers overrun while an
/// estimator computes.
inline constexpr int default_priority = 40;

/// The real-time settings for a process.
struct Request {
  int priority = default_priority;   ///< of SCHED_FIFO, 1 to 99
  std::optional<int> cpu{};          ///< the only CPU to run on; none: unchanged
  std::size_t heap_bytes = 8 << 20;  ///< faulted in beforehand; the heap can grow larger
};

/// Puts this process under SCHED_FIFO, locks its memory, faults in stack and heap, sets the timer slack to
/// 1 ns, pins the process, and keeps the CPUs out of deep sleep if /dev/cpu_dma_latency is writable. Call it
/// before starting threads. Error: one line with the remedy; if rights are missing, nothing is changed.
Result<void> enter(const Request& request);

/// Faults in the memory of a real-time process again: after a fork() the first write to each page costs a
/// fault. False: the memory could not be locked.
bool own_memory_again();

/// The CPUs that this process may run on.
std::vector<int> cpus();
/// Error: this process may not run on the CPU. `option`: the option that requested it.
Result<void> check_cpu(const std::string& option, int cpu);
/// Restricts the calling process to some CPUs; false if the kernel refuses.
bool pin(const std::vector<int>& cpus);

/// The settings in force for this process, as the kernel reports them.
struct Standing {
  std::string policy;  ///< SCHED_FIFO, SCHED_OTHER ...
  int priority = 0;    ///< 0 unless a real-time policy is in force
  std::vector<int> cpus;
  std::int64_t locked_kib = 0;
  std::int64_t timer_slack_ns = 0;     ///< Linux 6.12 and later reports 0 under a real-time policy
  bool awake = false;                  ///< this process keeps the CPUs out of deep sleep
  std::vector<std::string> governors;  ///< of its CPUs; empty: the kernel does not scale their frequency
  std::string preemption;              ///< of the kernel
};
Standing standing();

/// One line: "SCHED_FIFO 40, CPU 1, 71 MiB locked, timer slack 1 ns, governor performance, PREEMPT_RT".
std::string to_text(const Standing& standing);

/// A warning line if the frequency of the CPUs follows the load; else empty.
std::string frequency_warning(const Standing& standing);

}  // namespace canhil::realtime
