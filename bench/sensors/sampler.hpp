// A sensor that measures every period.
#pragma once

#include "bench/sensors/kind.hpp"

namespace canhil::sensors {

/// Sample k is valid at k * period, and is sent one latency after this time. No sample is sent after the end
/// of the run, because an answer after the end would not be observed. `Settings`: the settings of the
/// sensor's table.
template <class Settings>
class Sampler : public Sensor {
 public:
  Sampler(const NodeSettings& node, const Run& run)
      : config_(*node.own<Settings>()),
        run_(run),
        period_us_(node.period_us()),
        latency_us_(node.latency_us()),
        valid_us_(period_us_) {}

  [[nodiscard]] std::int64_t due_us() const final {
    const std::int64_t due_us = valid_us_ + latency_us_;
    return due_us > run_.flight.end_us() ? never_us : due_us;
  }
  Sample measure() final {
    Sample sample{.valid_us = valid_us_, .stamp_us = valid_us_};
    if (!take(valid_us_, sample)) sample.fate = Sample::Fate::lost;
    valid_us_ += period_us_;
    return sample;
  }

 protected:
  const Settings config_;
  const Run run_;

 private:
  /// Fills in the sample that is valid at `valid_us`. Returns false if the sample is lost.
  virtual bool take(std::int64_t valid_us, Sample& sample) = 0;

  std::int64_t period_us_;
  std::int64_t latency_us_;
  std::int64_t valid_us_;
};

}  // namespace canhil::sensors
