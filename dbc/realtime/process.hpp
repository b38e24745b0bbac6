// A process that is to be on time: scheduled before others, its memory held in place, on a CPU of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dbc/wire/result.hpp"

namespace canhil::realtime {

/// Below 50, at which PREEMPT_RT runs the threads of interrupts: the one that empties the CAN controller goes
/// first, so its few buffers do not overrun while an estimator computes.
inline constexpr int default_priority = 40;

/// What a program is asked to take for itself.
struct Request {
  int priority = default_priority;   ///< of SCHED_FIFO, 1 to 99
  std::optional<int> cpu{};          ///< the only one to run on; none: as it was
  std::size_t heap_bytes = 8 << 20;  ///< made present beforehand; it grows beyond when it must
};

/// Puts this process under SCHED_FIFO, locks its memory, makes stack and heap present, sets the timer slack
/// to 1 ns, pins it, and keeps the CPUs out of deep sleep where /dev/cpu_dma_latency may be written. Call it
/// before any thread is started. Error: one line with the remedy; nothing was changed where rights are
/// missing.
Result<void> enter(const Request& request);

/// Makes the memory of a process that has entered present again: after a fork() each page of it would cost a
/// fault when it is first written to. False: the memory may not be locked.
bool own_memory_again();

/// The CPUs that this process may run on.
std::vector<int> cpus();
/// Error: it is none of the CPUs that this process may run on. `option`: where it was asked for.
Result<void> check_cpu(const std::string& option, int cpu);
/// Restricts the calling process to some CPUs; false if the kernel will not.
bool pin(const std::vector<int>& cpus);

/// What is in force for this process, as the kernel tells it.
struct Standing {
  std::string policy;  ///< SCHED_FIFO, SCHED_OTHER ...
  int priority = 0;    ///< 0 unless a real-time policy is in force
  std::vector<int> cpus;
  std::int64_t locked_kib = 0;
  std::int64_t timer_slack_ns = 0;     ///< Linux 6.12 and later says 0 under a real-time policy
  bool awake = false;                  ///< this process keeps the CPUs out of deep sleep
  std::vector<std::string> governors;  ///< of its CPUs; empty: their frequency is not scaled by the kernel
  std::string preemption;              ///< of the kernel
};
Standing standing();

/// One line: "SCHED_FIFO 40, CPU 1, 71 MiB locked, timer slack 1 ns, governor performance, PREEMPT_RT".
std::string to_text(const Standing& standing);

/// The line for a person when the frequency of the CPUs follows the load; else empty.
std::string frequency_warning(const Standing& standing);

}  // namespace canhil::realtime
