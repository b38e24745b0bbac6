// How long the host took each CPU away from all ordinary programs.
#pragma once

#include <pthread.h>
#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <vector>

#include "bench/checks/histogram.hpp"

namespace canhil::observe {

/// Wakes a thread of high real-time priority every 1 ms on each CPU on which the target may run, as
/// cyclictest does, and records how late each thread runs. The target's own work cannot delay these threads.
/// The hypervisor, interrupts and the kernel can, and they delay the target on that CPU too; a hypervisor
/// need not report the time that it takes ("steal"). Needs the permission for SCHED_FIFO; records nothing
/// without it.
class CpuStalls {
 public:
  static constexpr std::chrono::milliseconds period{1};
  static constexpr int priority = 80;  ///< of the threads: above the bench, as is usual for cyclictest

  /// The threads run on the CPUs of a process until record() or destruction.
  explicit CpuStalls(pid_t process);
  ~CpuStalls();
  CpuStalls(const CpuStalls&) = delete;
  CpuStalls& operator=(const CpuStalls&) = delete;
  /// Ends the threads. Returns the delays of all wake-ups on all CPUs.
  [[nodiscard]] checks::Histogram record();

 private:
  struct Probe {
    const std::atomic<bool>* stop;
    checks::Histogram delays{};
    pthread_t thread{};
  };
  static void* watch(void* probe);
  void end();

  std::atomic<bool> stop_{false};
  std::vector<std::unique_ptr<Probe>> probes_;
};

}  // namespace canhil::observe
