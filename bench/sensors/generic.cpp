#include "bench/sensors/generic.hpp"

#include <fmt/format.h>

#include "bench/sensors/constant_error.hpp"
#include "bench/sensors/error_stack.hpp"
#include "bench/sensors/sampler.hpp"

namespace canhil::sensors {
namespace {

constexpr std::int64_t usual_period_us = 100'000;

std::optional<GenericValue> read_value(Section& section) {
  const Limits sigma = Limits::at_least(0);
  auto truth =
      scenario::read_expression(section, "truth", "The true value in SI: an expression (mapping.md).");
  std::optional<scenario::Expression> valid;
  if (section.has("valid"))
    valid = scenario::read_expression(
        section, "valid", "Where this expression is 0, the value is invalid (without this key: never).");
  section.optional("valid");
  world::ErrorStack stack;
  stack.bandwidth = section.number({"bandwidth_hz", "Bandwidth of a lag of the sensor; 0: none."}, sigma, 0);
  stack.order = read_order(section, "filter_order", "bandwidth_hz");
  const world::RandomValue scale = read_constant(section, "scale_factor_ppm", "the scale"),
                           bias = read_constant(section, "bias", "the value, in its SI unit");
  stack.correlated = section.number(
      {"correlated", "1-sigma of an error that is correlated in time, in the value's SI unit."}, sigma, 0);
  stack.correlation_s =
      section.number({"correlation_s", "Correlation time of the error `correlated`."}, Limits::above(0), 60);
  stack.random_walk =
      section.number({"random_walk", "Random walk, 1-sigma after 1 s, in the value's SI unit."}, sigma, 0);
  const double noise =
      section.number({"noise", "White noise, 1-sigma of a sample, in the value's SI unit."}, sigma, 0);
  stack.lowest = section.optional_number({"lowest", "The sensor saturates at this value."}, {})
                     .value_or(-world::ErrorStack::unlimited);
  stack.highest = section.optional_number({"highest", "The sensor saturates at this value."}, {})
                      .value_or(world::ErrorStack::unlimited);
  stack.step =
      section.number({"quantum", "Step of the sensor's output, in the value's SI unit; 0: none."}, sigma, 0);
  if (stack.lowest > stack.highest) section.reject("lowest", "is above highest", "a smaller value");
  section.finish();
  if (!truth) return std::nullopt;
  return GenericValue{.truth = std::move(*truth),
                      .valid = std::move(valid),
                      .scale_factor = scale,
                      .bias = bias,
                      .noise = noise,
                      .stack = stack};
}

NodeSettings read(const NodeTable& table, Section& section) {
  GenericSettings node;
  node.schedule = read_schedule(section);
  node.loss = read_sample_loss(section);
  Section values =
      section.table({"values", "A table for each value that the mapping declares: `[sensor.values.NAME]`."});
  for (const Output& output : table.sensor->outputs.values) {
    Section value = values.table(output.name);
    if (auto read = read_value(value)) node.values.push_back(std::move(*read));
  }
  values.finish();
  return {table, node};
}

// One value of a run. dt: time from one sample to the next [s].
class Value {
 public:
  Value(const GenericValue& of, const Run& run, std::string_view name, double dt)
      : of_(of),
        stream_(run.stream(fmt::format("generic.{}", name))),
        scale_(1 + draw(of.scale_factor, stream_)),
        bias_(draw(of.bias, stream_)),
        errors_(of.stack, dt, stream_) {}

  /// The value at `t_us`. None: it is invalid.
  std::optional<double> at(const world::Truths& truths, std::int64_t t_us) {
    errors_.wander(stream_);
    const double white = of_.noise * stream_.normal();
    const auto truth = of_.truth.at(truths, t_us);
    const auto valid = of_.valid ? of_.valid->at(truths, t_us) : 1;
    if (!truth) return std::nullopt;
    const double lagged = errors_.lag(*truth);
    if (!valid || *valid == 0) return std::nullopt;
    return errors_.given(scale_ * lagged + bias_ + errors_.correlated() + errors_.walk() + white);
  }

 private:
  GenericValue of_;
  world::Stream stream_;
  double scale_, bias_;
  world::AxisErrors errors_;
};

class Generic final : public LossySampler<GenericSettings> {
 public:
  Generic(const NodeSettings& node, const Run& run)
      : LossySampler(node, run, "generic.loss"), truths_{.flight = run.flight, .plants = run.plants} {
    const double dt = 1e-6 * static_cast<double>(node.period_us());
    const auto outputs = node.table().sensor->outputs.values;
    for (std::size_t i = 0; i < outputs.size(); ++i)
      values_.emplace_back(config_.values[i], run, outputs[i].name, dt);
    held_.resize(outputs.size(), 0.0);
  }

 private:
  // While a value is invalid, the last valid one is sent.
  void fill(std::int64_t t_us, Sample& sample) override {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (const auto value = values_[i].at(truths_, t_us))
        held_[i] = *value;
      else
        sample.invalid |= 1U << i;
      sample.values[i] = held_[i];
    }
  }

  world::Truths truths_;
  std::vector<Value> values_;
  std::vector<double> held_;
};

std::string why_no_truth(const NodeSettings& node, const scenario::Scenario& scenario) {
  const auto* settings = node.own<GenericSettings>();
  if (settings == nullptr) return {};
  for (const GenericValue& value : settings->values) {
    if (std::string why = scenario::why_no_truth(scenario, value.truth); !why.empty()) return why;
    if (!value.valid) continue;
    if (std::string why = scenario::why_no_truth(scenario, *value.valid); !why.empty()) return why;
  }
  return {};
}

}  // namespace

constinit const Kind generic{.key = "generic",
                             .read = read,
                             .make = make<Generic>,
                             .outputs = {},
                             .period_us = usual_period_us,
                             .only_named = true,
                             .why_no_truth = why_no_truth};

}  // namespace canhil::sensors
