#include "bench/observe/cpu_stalls.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <chrono>
#include <thread>

namespace canhil::observe {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

bool may_have_priority(int priority) {
  bool may = false;
  std::thread([&] {
    const sched_param parameters{.sched_priority = priority};
    may = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) == 0;
  }).join();
  return may;
}

// Another thread keeps a CPU busy. Priority 0: an ordinary thread.
checks::Histogram stalls_while_busy_for(nanoseconds busy, int priority) {
  CpuStalls stalls(getpid());
  std::thread([&] {
    const sched_param parameters{.sched_priority = priority};
    pthread_setschedparam(pthread_self(), priority > 0 ? SCHED_FIFO : SCHED_OTHER, &parameters);
    const auto end = std::chrono::steady_clock::now() + busy;
    while (std::chrono::steady_clock::now() < end) {
    }
  }).join();
  return stalls.record();
}

TEST(CpuStalls, SeeWhatIsMoreUrgentThanTheProbes) {  // as a hypervisor is
  if (!may_have_priority(CpuStalls::priority + 1)) {
    EXPECT_EQ(stalls_while_busy_for(1ms, 0).count(), 0U) << "nothing is known without the permission";
    return;
  }
  EXPECT_GE(stalls_while_busy_for(50ms, CpuStalls::priority + 1).max_ns(), nanoseconds(40ms).count());
}

TEST(CpuStalls, AnOrdinaryProgramCausesNone) {
  if (!may_have_priority(CpuStalls::priority)) return;  // the other test says what happens then
  const auto stalls = stalls_while_busy_for(300ms, 0);
  EXPECT_GE(stalls.count(), 100U);
  EXPECT_LE(stalls.quantile_ns(0.9), 1e-2 * static_cast<double>(nanoseconds(300ms).count()));
}

}  // namespace
}  // namespace canhil::observe
