#pragma once
// The last deflections of the fins with their own times of validity, so that a step of the filter uses what
// acted over it.
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "target/estimators/wind/airframe.hpp"

namespace canhil::wind {

enum class FinOutcome : std::uint8_t {
  kept,
  out_of_order,  // valid before the newest, or with it
  not_physical,  // not finite, or beyond the airframe's limit
};

/// The mean deflection over an interval.
struct ActingFins {
  Deflection mean;
  std::int64_t gap_us = 0;    // longest time without a sample that the interval reaches into
  bool known = false;         // false: no sample at all, mean is zero
  bool not_physical = false;  // the last frame was refused
};

class FinHistory {
 public:
  /// Deflections [rad] valid at t_us; each at most `limit`. In the order of their times: one that is not is
  /// out of order, but two in a row, one after the other and 0.1 s before the newest, say that its time was
  /// wrong: the history begins anew with the two.
  FinOutcome push(std::int64_t t_us, const Deflection& deflection, double limit);

  /// The mean over [from, to] of the samples joined by lines, the newest held after it, the oldest before it.
  ActingFins over(std::int64_t from_us, std::int64_t to_us) const;

 private:
  struct Sample {
    std::int64_t t_us = 0;
    Deflection deflection;
  };
  const Sample& back(std::size_t age) const { return samples_[(count_ - 1 - age) % samples_.size()]; }

  std::array<Sample, 64> samples_{};  // 1.3 s at 50 Hz
  std::size_t count_ = 0;
  std::optional<Sample> out_of_order_{};  // the last one, if it was
  bool last_refused_ = false;
};

}  // namespace canhil::wind
