// Makes this process a real-time process: real-time scheduling, locked memory, and optionally only one CPU.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::realtime {

/// The default must be below 50, because interrupt threads have priority 50 under PREEMPT_RT. The interrupt
/// thread that reads frames from the CAN controller must be able to interrupt the estimator; otherwise the
/// few buffers of the controller overflow while the estimator computes.
inline constexpr int default_priority = 40;

/// The real-time settings for a process.
struct Request {
  int priority = default_priority;  ///< priority under SCHED_FIFO, 1 to 99
  std::optional<int> cpu{};         ///< the only CPU on which the process may run; nullopt: unchanged
  std::size_t heap_bytes =
      8 << 20;  ///< so many bytes of the heap are accessed in advance; the heap can still grow
};

/// Puts this process under SCHED_FIFO, locks its memory, accesses all pages of stack and heap, sets the timer
/// slack to 1 ns, and pins the process to the requested CPU. If /dev/cpu_dma_latency is writable, also keeps
/// the CPUs out of deep sleep. Call enter() before threads are started. An error is one line with the remedy;
/// if rights are missing, nothing has been changed.
Result<void> enter(const Request& request);

/// After a fork(), the first write to each page would cause a page fault. own_memory_again() copies and locks
/// all pages of a real-time process at once. False: the memory could not be locked.
bool own_memory_again();

/// The CPUs on which this process may run.
std::vector<int> cpus();
/// Returns an error if this process may not run on the CPU. `option` is the option with which the user
/// requested the CPU.
Result<void> check_cpu(const std::string& option, int cpu);
/// Restricts this process to the given CPUs; false: the kernel refused.
bool pin(const std::vector<int>& cpus);

/// The real-time settings that this process has at present, as the kernel reports them.
struct Standing {
  std::string policy;  ///< scheduling policy: SCHED_FIFO, SCHED_OTHER ...
  int priority = 0;    ///< priority under a real-time policy; 0 under another policy
  std::vector<int> cpus;
  std::int64_t locked_kib = 0;
  std::int64_t timer_slack_ns = 0;  ///< Linux 6.12 and later reports 0 under a real-time policy
  bool awake = false;               ///< true: this process keeps the CPUs out of deep sleep
  /// The frequency governors of the CPUs; empty: the kernel does not scale the frequency.
  std::vector<std::string> governors;
  std::string preemption;  ///< preemption model of the kernel
};
Standing standing();

/// One line, such as "SCHED_FIFO 40, CPU 1, 71 MiB locked, timer slack 1 ns, governor performance,
/// PREEMPT_RT".
std::string to_text(const Standing& standing);

/// A line with a warning, if the frequency of the CPUs changes with the load; otherwise an empty string.
std::string frequency_warning(const Standing& standing);

}  // namespace canhil::realtime
