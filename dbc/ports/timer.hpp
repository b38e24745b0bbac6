// A timer on CLOCK_MONOTONIC for which poll() can wait.
#pragma once

#include <sys/timerfd.h>

#include <cstdint>
#include <ctime>

#include "dbc/ports/descriptor.hpp"

namespace canhil {

class Timer {
 public:
  Timer() : timer_(::timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC)) {}

  /// Sets the time at_ns at which the descriptor becomes readable. It then remains readable until the next
  /// set(). If at_ns is 0, the descriptor never becomes readable.
  void set(std::int64_t at_ns) {
    constexpr std::int64_t ns_per_s = 1'000'000'000;
    itimerspec time{};
    time.it_value = {.tv_sec = static_cast<std::time_t>(at_ns / ns_per_s),
                     .tv_nsec = static_cast<long>(at_ns % ns_per_s)};
    ::timerfd_settime(timer_.get(), TFD_TIMER_ABSTIME, &time, nullptr);
  }
  [[nodiscard]] int descriptor() const { return timer_.get(); }

 private:
  Descriptor timer_;
};

}  // namespace canhil
