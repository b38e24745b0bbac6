// A sensor that measures every period.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "bench/sensors/kind.hpp"
#include "bench/sensors/sample_loss.hpp"

namespace canhil::sensors {

/// Sample k is valid at k * period. It is taken then, but for its jitter, and is sent one latency after this
/// time. No sample is sent after the end of the run, because an answer after the end would not be observed.
/// `Settings`: the settings of the sensor's table. `first`: the first k; `last`: the last k, if it is not the
/// end of the run that ends the samples.
template <class Settings>
class Sampler : public Sensor {
 public:
  Sampler(const NodeSettings& node, const Run& run, std::int64_t first = 1,
          std::optional<std::int64_t> last = {})
      : config_(*node.own<Settings>()),
        run_(run),
        period_us_(node.period_us()),
        times_(run.stream(std::string(node.table().key) + ".times")),
        valid_us_(first * period_us_),
        last_us_(last ? *last * period_us_ : never_us) {
    schedule_next();
  }

  [[nodiscard]] std::int64_t due_us() const final {
    return valid_us_ > last_us_ || due_us_ > run_.flight.end_us() ? never_us : due_us_;
  }
  Sample measure() final {
    Sample sample{.valid_us = valid_us_, .stamp_us = valid_us_};
    if (!take(taken_us_, sample)) sample.fate = Sample::Fate::lost;
    valid_us_ += period_us_;
    schedule_next();
    if (due_us() != never_us) next_is(taken_us_);
    return sample;
  }

 protected:
  const Settings config_;
  const Run run_;

 private:
  /// Fills in the sample that is taken at `taken_us`. Returns false if the sample is lost.
  virtual bool take(std::int64_t taken_us, Sample& sample) = 0;
  /// Called when it is known when the next sample is taken.
  virtual void next_is(std::int64_t /*taken_us*/) {}

  void schedule_next() {
    const scenario::Schedule& schedule = config_.schedule;
    std::int64_t latency_us = schedule.latency_us;
    if (schedule.latency_spread_us > 0)
      latency_us += std::llround(times_.uniform() * static_cast<double>(schedule.latency_spread_us));
    due_us_ = std::max(due_us_, valid_us_ + latency_us);
    taken_us_ = valid_us_;
    if (schedule.jitter <= 0) return;
    const double half = static_cast<double>(period_us_) / 2;
    const double jitter_us = std::clamp(1e6 * schedule.jitter * times_.normal(), -half, half);
    // A flight that grows is known up to the time at which the sample is sent.
    const std::int64_t last_us =
        run_.flight.grows() ? std::min(due_us_, run_.flight.end_us()) : run_.flight.end_us();
    taken_us_ = std::clamp<std::int64_t>(valid_us_ + std::llround(jitter_us), 0, last_us);
  }

  std::int64_t period_us_;
  world::Stream times_;
  std::int64_t valid_us_;
  std::int64_t last_us_;
  std::int64_t due_us_ = 0;    // of the next sample
  std::int64_t taken_us_ = 0;  // the next sample
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
  /// Fills in the sample that is taken at `taken_us`.
  virtual void fill(std::int64_t taken_us, Sample& sample) = 0;
  bool take(std::int64_t taken_us, Sample& sample) final {
    fill(taken_us, sample);
    return !is_lost(this->config_.loss, sample.valid_us, losses_);
  }
};

}  // namespace canhil::sensors
