// How the host delays the target: its waits for a CPU, and the stalls of its CPUs.
#pragma once

#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "bench/checks/host.hpp"
#include "bench/observe/cpu_stalls.hpp"
#include "bench/observe/target_waits.hpp"

namespace canhil::observe {

/// Watches a process from the construction of this object until record().
class DelayWatch {
 public:
  /// `stalls`: measure the stalls too, which takes threads of high priority.
  DelayWatch(pid_t process, bool stalls) : waits_(process) {
    if (stalls) stalls_.emplace(process);
  }
  /// See TargetWaits::follow().
  void follow(pid_t process) { waits_.follow(process); }
  [[nodiscard]] checks::TargetDelays record() {
    return {.waits = waits_.record(), .stalls = stalls_ ? stalls_->record() : checks::Histogram()};
  }

 private:
  TargetWaits waits_;
  std::optional<CpuStalls> stalls_;
};

/// Watches several processes.
class DelayWatches {
 public:
  DelayWatches(const std::vector<pid_t>& processes, bool stalls) {
    for (const pid_t process : processes) watches_.emplace_back(process, stalls);
  }
  /// See TargetWaits::follow(); `processes`: as many as before.
  void follow(const std::vector<pid_t>& processes) {
    for (std::size_t i = 0; i < processes.size(); ++i) watches_[i].follow(processes[i]);
  }
  /// The record of the process with the longest wait.
  [[nodiscard]] checks::TargetDelays record() {
    checks::TargetDelays worst;
    for (DelayWatch& one : watches_) {
      checks::TargetDelays delays = one.record();
      if (delays.waits.max_ns() >= worst.waits.max_ns()) worst = std::move(delays);
    }
    return worst;
  }

 private:
  std::deque<DelayWatch> watches_;
};

}  // namespace canhil::observe
