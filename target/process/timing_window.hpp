// The target's own timing over the last window, as TargetTiming reports it.
#pragma once

#include <algorithm>
#include <cstdint>

#include "messages/canhil.hpp"

namespace canhil::target {

/// Collects what frames waited and took.
class TimingWindow {
 public:
  /// What a frame waited between its stamp and its processing.
  void waited(std::int64_t queue_ns) {
    queue_max_ns_ = std::max(queue_max_ns_, queue_ns);
    queue_sum_ns_ += queue_ns;
    ++frames_;
  }

  /// What the processing of a frame took that was answered.
  void computed(std::int64_t compute_ns) {
    compute_max_ns_ = std::max(compute_max_ns_, compute_ns);
    compute_sum_ns_ += compute_ns;
    ++answers_;
  }

  /// The message of the window; starts a new one. Times saturate at 8191 us, as the message does.
  messages::TargetTiming take() {
    const messages::TargetTiming message{
        .queue_max_us = microseconds(queue_max_ns_),
        .queue_mean_us = microseconds(queue_sum_ns_ / std::max<std::int64_t>(frames_, 1)),
        .compute_max_us = microseconds(compute_max_ns_),
        .compute_mean_us = microseconds(compute_sum_ns_ / std::max<std::int64_t>(answers_, 1))};
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
  std::int64_t frames_ = 0;
  std::int64_t answers_ = 0;
};

}  // namespace canhil::target
