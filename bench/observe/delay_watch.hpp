// How the host delays the target: its waits for a CPU, and the stalls of its CPUs.
#pragma once

#include <optional>

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

}  // namespace canhil::observe
