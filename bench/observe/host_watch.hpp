// Watches the bench's own machine during a run: steps of its clock, and the times in which the bench waited
// for a CPU.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "bench/checks/host.hpp"
#include "bench/observe/observer.hpp"

namespace canhil::observe {

/// Finds steps of one clock against another. A step is a change of the difference between the clocks, from
/// one reading to the next, by more than 100 us plus 500 ppm of the elapsed time: an adjusted clock drifts by
/// at most 500 ppm (adjtimex).
class ClockSteps {
 public:
  /// Takes the readings of both clocks at one instant.
  void note(std::int64_t steady_ns, std::int64_t stamps_ns);
  /// The largest step, with its sign; 0: there was no step.
  [[nodiscard]] std::int64_t largest_ns() const { return largest_ns_; }

 private:
  struct Reading {
    std::int64_t steady_ns, stamps_ns;
  };
  std::optional<Reading> before_;
  std::int64_t largest_ns_ = 0;
};

/// CPU times from the kernel. The times of the calling thread count from the start of the thread, those of
/// the machine from the start of the machine.
struct CpuAccount {
  std::int64_t run_ns = 0;   ///< the thread was running
  std::int64_t wait_ns = 0;  ///< the thread was ready to run but had no CPU
  std::uint64_t preempted = 0;
  std::uint64_t all_ticks = 0;     ///< sum over all CPUs
  std::uint64_t stolen_ticks = 0;  ///< part of all_ticks that the hypervisor gave to other guests
};
/// Parses /proc/thread-self/schedstat and /proc/stat; missing values are 0.
CpuAccount cpu_account(std::string_view schedstat, std::string_view stat);

/// Watches from the construction of this object on.
class HostWatch final : public Observer {
 public:
  /// `stamp_clock`: Port::stamp_clock(). `may_be_realtime`: see checks::HostRecord.
  HostWatch(int stamp_clock, bool may_be_realtime);
  void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override;
  [[nodiscard]] checks::HostRecord record() const;

 private:
  int stamp_clock_;
  bool may_be_realtime_;
  std::int64_t start_ns_;
  CpuAccount start_;
  ClockSteps steps_;
};

}  // namespace canhil::observe
