// How late the host wakes a thread.
#pragma once

#include <cstdint>
#include <ctime>

#include "dbc/ports/port.hpp"

namespace canhil::realtime {

/// Works like cyclictest: once in each period, sleeps until an absolute time of CLOCK_MONOTONIC, then reads
/// the clock and calls late(late_ns). Ends when go_on(due_ns) returns false for the next wake-up.
template <class GoOn, class Late>
void wake_each(std::int64_t period_ns, GoOn&& go_on, Late&& late) {
  constexpr std::int64_t ns_per_s = 1'000'000'000;
  std::int64_t due_ns = clock_ns(CLOCK_MONOTONIC) + period_ns;
  while (go_on(due_ns)) {
    const timespec due{.tv_sec = due_ns / ns_per_s, .tv_nsec = due_ns % ns_per_s};
    if (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr) != 0)
      continue;  // a signal interrupted the sleep
    const std::int64_t late_ns = clock_ns(CLOCK_MONOTONIC) - due_ns;
    late(late_ns);
    // Skips the periods that passed during a late wake-up; otherwise one delay would count several times.
    due_ns += period_ns * (1 + late_ns / period_ns);
  }
}

}  // namespace canhil::realtime
