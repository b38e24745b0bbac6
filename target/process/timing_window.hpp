// Collects how long frames wait in the target and how long their processing takes, for TargetTiming.
#pragma once

#include <algorithm>
#include <cstdint>

#include "messages/canhil.hpp"

namespace canhil::target {

/// Collects waiting and processing times of the frames that the device answered, except Sync and commands.
/// Most of these frames are the last frames of sample groups.
class TimingWindow {
 public:
  /// Adds a frame's waiting time, from its time stamp to the start of its processing, and its processing
  /// time.
  void add(std::int64_t queue_ns, std::int64_t compute_ns) {
    queue_max_ns_ = std::max(queue_max_ns_, queue_ns);
    queue_sum_ns_ += queue_ns;
    compute_max_ns_ = std::max(compute_max_ns_, compute_ns);
    compute_sum_ns_ += compute_ns;
    ++count_;
  }

  /// Returns the message for the window, and starts a new window. Times saturate at 8191 us, the limit of the
  /// message.
  messages::TargetTiming take() {
    const std::int64_t count = std::max<std::int64_t>(count_, 1);
    const messages::TargetTiming message{.queue_max_us = microseconds(queue_max_ns_),
                                         .queue_mean_us = microseconds(queue_sum_ns_ / count),
                                         .compute_max_us = microseconds(compute_max_ns_),
                                         .compute_mean_us = microseconds(compute_sum_ns_ / count)};
    *this = TimingWindow();
    return message;
  }

 private:
  static std::uint16_t microseconds(std::int64_t ns) {
    return static_cast<std::uint16_t>(std::clamp<std::int64_t>((ns + 500) / 1000, 0, 8191));
  }
  std::int64_t queue_max_ns_ = 0;
  std::int64_t queue_sum_ns_ = 0;
  std::int64_t compute_max_ns_ = 0;
  std::int64_t compute_sum_ns_ = 0;
  std::int64_t count_ = 0;
};

}  // namespace canhil::target
