#include "bench/observe/host_watch.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "messages/canhil.hpp"

namespace canhil::observe {
namespace {

constexpr std::int64_t least_step_ns = 100'000;
constexpr std::int64_t slewed_ppm = 500;
// The two clocks are read one after the other. If the process lost the CPU, so that a pair of readings took
// longer than this time, the pair is ignored.
constexpr std::int64_t longest_reading_ns = 20'000;

std::string content(const char* path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

CpuAccount cpu_account_now() {
  CpuAccount account = cpu_account(content("/proc/thread-self/schedstat"), content("/proc/stat"));
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  account.preempted = static_cast<std::uint64_t>(usage.ru_nivcsw);
  return account;
}

}  // namespace

void ClockSteps::note(std::int64_t steady_ns, std::int64_t stamps_ns) {
  if (before_) {
    const std::int64_t passed_ns = steady_ns - before_->steady_ns;
    const std::int64_t step_ns = stamps_ns - before_->stamps_ns - passed_ns;
    if (std::abs(step_ns) > least_step_ns + passed_ns * slewed_ppm / 1'000'000 &&
        std::abs(step_ns) > std::abs(largest_ns_))
      largest_ns_ = step_ns;
  }
  before_ = {steady_ns, stamps_ns};
}

CpuAccount cpu_account(std::string_view schedstat, std::string_view stat) {
  CpuAccount account;
  std::istringstream own{std::string(schedstat)};
  own >> account.run_ns >> account.wait_ns;
  // Fields: cpu user nice system idle iowait irq softirq steal; user and nice include guest time.
  std::istringstream all{std::string(stat)};
  std::string name;
  all >> name;
  for (int column = 0; column < 8; ++column) {
    std::uint64_t ticks = 0;
    if (!(all >> ticks)) break;
    account.all_ticks += ticks;
    account.stolen_ticks = ticks;
  }
  return account;
}

HostWatch::HostWatch(int stamp_clock, bool may_be_realtime)
    : stamp_clock_(stamp_clock),
      may_be_realtime_(may_be_realtime),
      start_ns_(clock_ns(CLOCK_MONOTONIC)),
      start_(cpu_account_now()) {}

void HostWatch::transmitted(const Frame& frame, std::int64_t /*t_ns*/, std::int64_t /*late_ns*/) {
  if (stamp_clock_ == CLOCK_MONOTONIC || frame.id != messages::Sync::info.id) return;
  const std::int64_t before_ns = clock_ns(CLOCK_MONOTONIC);
  const std::int64_t stamps_ns = clock_ns(stamp_clock_);
  const std::int64_t after_ns = clock_ns(CLOCK_MONOTONIC);
  if (after_ns - before_ns <= longest_reading_ns) steps_.note((before_ns + after_ns) / 2, stamps_ns);
}

checks::HostRecord HostWatch::record() const {
  const CpuAccount now = cpu_account_now();
  const double all = static_cast<double>(std::max<std::uint64_t>(now.all_ticks - start_.all_ticks, 1));
  return {.clock_step_ns = steps_.largest_ns(),
          .wall_s = static_cast<double>(clock_ns(CLOCK_MONOTONIC) - start_ns_) * 1e-9,
          .cpu_run_s = static_cast<double>(now.run_ns - start_.run_ns) * 1e-9,
          .cpu_wait_s = static_cast<double>(now.wait_ns - start_.wait_ns) * 1e-9,
          .stolen_share = static_cast<double>(now.stolen_ticks - start_.stolen_ticks) / all,
          .may_be_realtime = may_be_realtime_,
          .preempted = now.preempted - start_.preempted};
}

}  // namespace canhil::observe
