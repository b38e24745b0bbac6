#include "bench/faults/sensors/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/faults/sensors/faulty_sensor.hpp"

namespace canhil::faults {
namespace {

class WithValues final : public FaultySensor {
 public:
  WithValues(std::unique_ptr<sensors::Sensor> sensor, const scenario::NodeSettings& settings,
             const InRun& run, const OfValues& of, const When& when, Becomes becomes)
      : FaultySensor(std::move(sensor), run),
        when_(run.in(when)),
        becomes_(std::move(becomes)),
        period_us_(settings.period_us()) {
    for (const Measured& one : of.all) {
      if (one.sensor->key == settings.table().key)
        own_.push_back({.value = one,
                        .occasions = Occasions(when_, run.stream(one.name)),
                        .noise = run.stream(one.name + ".noise")});
    }
  }

 private:
  struct Own {
    Measured value;
    Occasions occasions;
    world::Stream noise;
    std::optional<double> held{};
  };

  void change(sensors::Sample& sample, std::int64_t t_us) override {
    for (Own& own : own_) {
      if (!when_.holds(t_us)) own.held.reset();
      if (!own.occasions.next(t_us)) continue;
      const double right = own.value.get(sample, period_us_);
      const double wrong =
          becomes_(right, {.since_us = t_us - when_.begins_us(), .held = own.held, .noise = own.noise});
      if (wrong == right) continue;  // has not struck: not yet saturated, or stuck where it was
      own.value.put(sample, period_us_, wrong);
      ++tally().count;
      ++tally().changed;
      if (own.value.is_time()) ++tally().changed_times;
    }
  }

  When when_;
  Becomes becomes_;
  std::int64_t period_us_;
  std::vector<Own> own_;
};

}  // namespace

bool act_on(const OfValues& of, const scenario::NodeTable& sensor) {
  return std::ranges::any_of(of.all, [&](const Measured& one) { return one.sensor->key == sensor.key; });
}

std::unique_ptr<sensors::Sensor> with_values(std::unique_ptr<sensors::Sensor> sensor,
                                             const scenario::NodeSettings& settings, const InRun& run,
                                             const OfValues& of, const When& when, Becomes becomes) {
  return std::make_unique<WithValues>(std::move(sensor), settings, run, of, when, std::move(becomes));
}

void Changed::check(scenario::Section& section) const {
  for (const auto& [signal, lowest, highest] : of.ranges) {
    if (size < lowest || size > highest)
      section.reject("value", fmt::format("{} is {:g}", signal, size),
                     fmt::format("{:g} to {:g}", lowest, highest));
  }
}

void Spike::check(scenario::Section& section) const {
  if (when.every > 1 || when.share < 1) return;
  section.reject("every", "is missing: a spike at each sample is a bias",
                 "every above 1, or percent below 100");
}

double Stuck::becomes(double value, double /*size*/, const Sampled& sample) {
  if (!sample.held) sample.held = value;
  return *sample.held;
}

double Saturated::becomes(double value, double size, const Sampled& /*sample*/) {
  return std::clamp(value, -size, size);
}

}  // namespace canhil::faults
