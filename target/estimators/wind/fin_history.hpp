#pragma once
// The last deflections of the fins with their times of validity, so that a step of the filter uses the
// deflections during that step.
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "target/estimators/wind/airframe.hpp"

namespace canhil::wind {

/// The outcome of adding a sample of the fins.
enum class FinOutcome : std::uint8_t {
  kept,
  out_of_order,  // not valid later than the newest sample
  not_physical,  // not finite, or beyond the airframe's limit
};

/// The mean deflection over an interval.
struct ActingFins {
  Deflection mean;
  std::int64_t gap_us = 0;    // the longest of the gaps between samples that overlap the interval
  bool known = false;         // false: no sample at all; mean is zero
  bool not_physical = false;  // the last frame was refused
};

/// The last 64 samples of the fins.
class FinHistory {
 public:
  /// Adds deflections [rad] that are valid at t_us. Refuses them as not physical if one of them is not finite
  /// or beyond `limit`, and as out of order if they are not later than the newest sample. If two consecutive
  /// samples are out of order, but the second is later than the first and more than 0.1 s earlier than the
  /// newest sample, then the newest sample had a wrong time, and the history restarts with these two samples.
  FinOutcome push(std::int64_t t_us, const Deflection& deflection, double limit);

  /// The mean of the deflections over [from, to]. The deflections are linearly interpolated between samples,
  /// and are constant after the newest sample and before the oldest.
  ActingFins over(std::int64_t from_us, std::int64_t to_us) const;

 private:
  struct Sample {
    std::int64_t t_us = 0;
    Deflection deflection;
  };
  const Sample& back(std::size_t age) const { return samples_[(count_ - 1 - age) % samples_.size()]; }

  std::array<Sample, 64> samples_{};  // 1.3 s at 50 Hz
  std::size_t count_ = 0;
  std::optional<Sample> out_of_order_{};  // the last sample, if it was out of order
  bool last_refused_ = false;
};

}  // namespace canhil::wind
