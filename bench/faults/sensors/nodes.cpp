#include "bench/faults/sensors/nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>

#include "bench/faults/sensors/faulty_sensor.hpp"
#include "bench/scenario/binding.hpp"
#include "bench/scenario/rule.hpp"

namespace canhil::faults {
namespace {

using scenario::FaultContext;
using scenario::NodeSettings;
using scenario::Section;
using sensors::Sample;
using sensors::Sensor;

const scenario::NodeTable* read_sent_node(Section& section, const FaultContext& context) {
  const scenario::NodeTable* node = read_node(section, context);
  if (node != nullptr && !context.contract.binding->carried(sensor_of(*node)).samples)
    section.reject("node", fmt::format("'{}' is in no message of the bench", node->key),
                   "one that the mapping plays");
  return node;
}

template <class Kind>
Kind read_of_node(Section& section, const FaultContext& context, Repeats repeats = Repeats::stretch) {
  Kind kind;
  kind.table = read_sent_node(section, context);
  kind.when = read_when(section, context, repeats);
  return kind;
}

// A wrong clock shows in the times of a sample and, if it runs too fast, in the rates, which are divided by
// the interval.
void expect_times(Section& section, const FaultContext& context, const scenario::NodeTable* node,
                  bool drifts) {
  if (node == nullptr) return;
  const auto carried = context.contract.binding->carried(sensor_of(*node));
  if (carried.samples && !carried.times && !(drifts && carried.intervals))
    section.reject("node", fmt::format("'{}' has no time in a message of the bench", node->key),
                   "one whose times the mapping plays");
}

class SilentSensor final : public FaultySensor {
 public:
  SilentSensor(std::unique_ptr<Sensor> sensor, const InRun& run, const When& when, bool restarts)
      : FaultySensor(std::move(sensor), run), when_(run.in(when)), restarts_(restarts) {}

  Sample measure() override {
    const std::int64_t t_us = sensor().due_us();
    Sample sample = sensor().measure();
    if (sample.fate == Sample::Fate::none) return sample;
    if (when_.holds(t_us)) {
      if (!restarts_) ++tally().count;
      sample.fate = Sample::Fate::none;
    } else if (restarts_ && t_us > when_.ends_us()) {
      // The counters restart even if the fault was too short to suppress a sample.
      restarts_ = false;
      sample.restarted = true;
      ++tally().count;
    }
    return sample;
  }

 private:
  When when_;
  bool restarts_;  // true: the counters must still restart
};

class LateSensor final : public FaultySensor {
 public:
  LateSensor(std::unique_ptr<Sensor> sensor, const InRun& run, const Late& kind)
      : FaultySensor(std::move(sensor), run),
        by_us_(kind.by_us),
        occasions_(run.in(kind.when), run.stream()) {}

  [[nodiscard]] std::int64_t due_us() const override {
    return waiting_.empty() ? sensor().due_us() : std::min(sensor().due_us(), waiting_.front().first);
  }
  Sample measure() override {
    if (waiting_.empty() || waiting_.front().first > sensor().due_us()) return FaultySensor::measure();
    const Sample late = waiting_.front().second;
    waiting_.pop_front();
    return late;
  }

 private:
  void change(Sample& sample, std::int64_t t_us) override {
    if (!occasions_.next(t_us)) return;
    ++tally().count;
    ++tally().overtaken;
    waiting_.emplace_back(t_us + by_us_, sample);
    sample.fate = Sample::Fate::none;
  }
  std::int64_t by_us_;
  Occasions occasions_;
  std::deque<std::pair<std::int64_t, Sample>> waiting_;  // by time, because all have the same delay
};

class SlowSensor final : public FaultySensor {
 public:
  SlowSensor(std::unique_ptr<Sensor> sensor, const NodeSettings& settings, const InRun& run, const Slow& kind)
      : FaultySensor(std::move(sensor), run),
        when_(run.in(kind.when)),
        period_us_(static_cast<double>(settings.period_us()) * kind.longer),
        outputs_(sensor_of(settings.table()).outputs.values) {}

 private:
  // During the fault, transmissions are due at multiples of the longer period, counted from the first sample.
  // A sample that comes before the next due time is not sent.
  void change(Sample& sample, std::int64_t t_us) override {
    add_kept(sample);
    if (!when_.holds(t_us)) {
      due_us_ = 0;
      return;
    }
    if (due_us_ == 0) due_us_ = static_cast<double>(t_us);
    if (static_cast<double>(t_us) >= due_us_) {
      due_us_ += period_us_;
      return;
    }
    kept_ = sample;
    sample.fate = Sample::Fate::none;
    ++tally().count;
  }
  // Adds the increments that were not sent.
  void add_kept(Sample& sample) {
    if (!kept_) return;
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      if (!outputs_[i].rate.empty()) sample.values[i] += kept_->values[i];
    }
    sample.interval_us += kept_->interval_us;
    kept_.reset();
  }
  When when_;
  double period_us_;
  std::span<const sensors::Output> outputs_;
  double due_us_ = 0;           // time when a transmission is next due; 0: not active
  std::optional<Sample> kept_;  // the latest sample that was not sent, with the increments before it
};

class WrongClock final : public FaultySensor {
 public:
  /// The node reports the time t + by + rate * (t - from).
  WrongClock(std::unique_ptr<Sensor> sensor, const InRun& run, const When& when, std::int64_t by_us,
             double rate)
      : FaultySensor(std::move(sensor), run), when_(run.in(when)), by_us_(by_us), rate_(rate) {}

 private:
  void change(Sample& sample, std::int64_t t_us) override {
    if (!when_.holds(t_us)) return;
    sample.stamp_us +=
        std::llround(static_cast<double>(by_us_) + rate_ * static_cast<double>(t_us - when_.begins_us()));
    sample.interval_us *= 1 + rate_;
    ++tally().count;
    ++tally().changed;
    ++tally().changed_times;
  }
  When when_;
  std::int64_t by_us_;
  double rate_;
};

}  // namespace

Silent Silent::read(Section& section, const FaultContext& context) {
  return read_of_node<Silent>(section, context);
}
std::unique_ptr<Sensor> Silent::with_fault(std::unique_ptr<Sensor> sensor, const NodeSettings& /*settings*/,
                                           const InRun& run) const {
  return std::make_unique<SilentSensor>(std::move(sensor), run, when, false);
}

NodeRestart NodeRestart::read(Section& section, const FaultContext& context) {
  NodeRestart kind;
  kind.table = read_sent_node(section, context);
  kind.when.from_us = section.time_us({"from_s", "Time of transmission at which the fault begins."},
                                      scenario::Limits::at_least(0));
  scenario::expect_within_run(section, "from_s", kind.when.from_us, context.duration_us);
  kind.when.to_us = kind.when.from_us + section.time_us({"silent_s", "Time for which the node is silent."},
                                                        scenario::Limits::at_least(0));
  return kind;
}
std::unique_ptr<Sensor> NodeRestart::with_fault(std::unique_ptr<Sensor> sensor,
                                                const NodeSettings& /*settings*/, const InRun& run) const {
  return std::make_unique<SilentSensor>(std::move(sensor), run, when, true);
}

Late Late::read(Section& section, const FaultContext& context) {
  auto kind = read_of_node<Late>(section, context, Repeats::each);
  kind.by_us = section.time_us({"by_ms", "Delay of the sample."}, scenario::Limits::above(0));
  return kind;
}
std::unique_ptr<Sensor> Late::with_fault(std::unique_ptr<Sensor> sensor, const NodeSettings& /*settings*/,
                                         const InRun& run) const {
  return std::make_unique<LateSensor>(std::move(sensor), run, *this);
}

Slow Slow::read(Section& section, const FaultContext& context) {
  auto kind = read_of_node<Slow>(section, context);
  kind.longer = 1 + section.number({"longer_percent", "Percentage by which the period is longer."},
                                   scenario::Limits::above(0, 100));
  return kind;
}
std::unique_ptr<Sensor> Slow::with_fault(std::unique_ptr<Sensor> sensor, const NodeSettings& settings,
                                         const InRun& run) const {
  return std::make_unique<SlowSensor>(std::move(sensor), settings, run, *this);
}

ClockStep ClockStep::read(Section& section, const FaultContext& context) {
  auto kind = read_of_node<ClockStep>(section, context);
  expect_times(section, context, kind.table, false);
  kind.by_us = section.time_us({"by_ms", "Size of the step, which is added to the times of validity."}, {});
  return kind;
}
std::unique_ptr<Sensor> ClockStep::with_fault(std::unique_ptr<Sensor> sensor,
                                              const NodeSettings& /*settings*/, const InRun& run) const {
  return std::make_unique<WrongClock>(std::move(sensor), run, when, by_us, 0);
}

ClockDrift ClockDrift::read(Section& section, const FaultContext& context) {
  auto kind = read_of_node<ClockDrift>(section, context);
  expect_times(section, context, kind.table, true);
  kind.rate = section.number({"by_ppm", "Relative error of the clock's rate; positive: too fast."},
                             scenario::Limits::between(-1e5, 1e5));
  return kind;
}
std::unique_ptr<Sensor> ClockDrift::with_fault(std::unique_ptr<Sensor> sensor,
                                               const NodeSettings& /*settings*/, const InRun& run) const {
  return std::make_unique<WrongClock>(std::move(sensor), run, when, 0, rate);
}

}  // namespace canhil::faults
