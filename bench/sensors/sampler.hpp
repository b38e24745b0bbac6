// A sensor that measures every period.
#pragma once

#include "bench/sensors/kind.hpp"
#include "bench/sensors/sample_loss.hpp"

namespace canhil::sensors {

/// Sample k is valid at k * period, and is sent one latency after this time. No sample is sent after the end
/// of the run, because an answer after the end would not be observed. `Settings`: the settings of the
/// sensor's table. `first`: the first k; `last`: the last k, if it is not the end of the run that ends the
/// samples.
template <class Settings>
class Sampler : public Sensor {
 public:
  Sampler(const NodeSettings& node, const Run& run, std::int64_t first = 1,
          std::optional<std::int64_t> last = {})
      : config_(*node.own<Settings>()),
        run_(run),
        period_us_(node.period_us()),
        latency_us_(node.latency_us()),
        valid_us_(first * period_us_),
        last_us_(last ? *last * period_us_ : never_us) {}

  [[nodiscard]] std::int64_t due_us() const final {
    const std::int64_t due_us = valid_us_ + latency_us_;
    return valid_us_ > last_us_ || due_us > run_.flight.end_us() ? never_us : due_us;
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
  std::int64_t last_us_;
};

/// A Sampler whose samples are lost by chance and in outages. `Settings` has a member `loss`.
template <class Settings>
class LossySampler : public Sampler<Settings> {
 public:
  /// `losses`: name of the stream of the losses. It is a separate stream, so that losses do not change the
  /// measurements.
  LossySampler(const NodeSettings& node, const Run& run, std::string_view losses)
      : Sampler<Settings>(node, run), losses_(run.stream(losses)) {}

 protected:
  world::Stream losses_;

 private:
  /// Fills in the sample that is valid at `valid_us`.
  virtual void fill(std::int64_t valid_us, Sample& sample) = 0;
  bool take(std::int64_t valid_us, Sample& sample) final {
    fill(valid_us, sample);
    return !is_lost(this->config_.loss, valid_us, losses_);
  }
};

}  // namespace canhil::sensors
