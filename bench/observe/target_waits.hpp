// How long the target waited for a CPU that other programs held.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <span>
#include <stop_token>
#include <thread>
#include <vector>

#include "bench/checks/histogram.hpp"
#include "bench/checks/host.hpp"

namespace canhil::observe {

/// CPU times of a thread since its start, from the kernel.
struct ThreadTimes {
  pid_t thread = 0;
  std::int64_t run_ns = 0;   ///< the thread was running
  std::int64_t wait_ns = 0;  ///< the thread was ready to run but had no CPU
};

/// Reads the times of all threads of a process and of the processes that it started. Empty: the kernel does
/// not report them, or the process has ended.
void read_thread_times(pid_t process, std::vector<ThreadTimes>& times);

/// The longest wait of one thread from the times `before` to the times `now`, without the time in which the
/// other threads ran. So a wait for another thread of the target does not count: it is the target's own
/// doing.
std::int64_t waited_for_others_ns(std::span<const ThreadTimes> before, std::span<const ThreadTimes> now);

/// Looks at the times of the target's threads, in a thread of its own, from the construction of this object
/// until record().
class TargetWaits {
 public:
  /// The time from one look to the next.
  static constexpr std::chrono::milliseconds period = checks::TargetDelays::part;

  explicit TargetWaits(pid_t process)
      : process_(process), thread_([this](const std::stop_token& stop) { look(stop); }) {}
  /// The target was started again, as this process.
  void follow(pid_t process) { process_ = process; }
  /// Ends the looks. Returns the waits in each period. If the times between two looks, or a wait, spans
  /// several periods, it counts in each of them.
  [[nodiscard]] checks::Histogram record();

 private:
  void look(const std::stop_token& stop);

  std::atomic<pid_t> process_;
  checks::Histogram waits_;
  std::jthread thread_;  // ends before the other members
};

}  // namespace canhil::observe
