#include "bench/sensors/generic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bench/sensors/constant_error.hpp"
#include "bench/sensors/sampler.hpp"

namespace canhil::sensors {
namespace {

constexpr std::int64_t usual_period_us = 100'000;
constexpr double infinity = std::numeric_limits<double>::infinity();

std::optional<GenericValue> read_value(Section& section) {
  const Limits sigma = Limits::at_least(0);
  auto truth =
      scenario::read_expression(section, "truth", "The true value in SI: an expression (mapping.md).");
  std::optional<scenario::Expression> valid;
  if (section.has("valid"))
    valid = scenario::read_expression(
        section, "valid", "Where this expression is 0, the value is invalid (without this key: never).");
  section.optional("valid");
  const double bandwidth =
      section.number({"bandwidth_hz", "Bandwidth of a first-order lag of the sensor; 0: none."}, sigma, 0);
  const world::RandomValue scale = read_constant(section, "scale_factor_ppm", "the scale"),
                           bias = read_constant(section, "bias", "the value, in its SI unit");
  const double correlated = section.number(
      {"correlated", "1-sigma of an error that is correlated in time, in the value's SI unit."}, sigma, 0);
  const double correlation_s =
      section.number({"correlation_s", "Correlation time of the error `correlated`."}, Limits::above(0), 60);
  const double walk =
      section.number({"random_walk", "Random walk, 1-sigma after 1 s, in the value's SI unit."}, sigma, 0);
  const double noise =
      section.number({"noise", "White noise, 1-sigma of a sample, in the value's SI unit."}, sigma, 0);
  const double
      lowest =
          section.optional_number({"lowest", "The sensor saturates at this value."}, {}).value_or(-infinity),
      highest =
          section.optional_number({"highest", "The sensor saturates at this value."}, {}).value_or(infinity);
  const double quantum =
      section.number({"quantum", "Step of the sensor's output, in the value's SI unit; 0: none."}, sigma, 0);
  if (lowest > highest) section.reject("lowest", "is above highest", "a smaller value");
  section.finish();
  if (!truth) return std::nullopt;
  return GenericValue{.truth = std::move(*truth),
                      .valid = std::move(valid),
                      .bandwidth = bandwidth,
                      .scale_factor = scale,
                      .bias = bias,
                      .correlated = correlated,
                      .correlation_s = correlation_s,
                      .random_walk = walk,
                      .noise = noise,
                      .lowest = lowest,
                      .highest = highest,
                      .quantum = quantum};
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

// One value of a run.
class Value {
 public:
  Value(const GenericValue& of, const Run& run, std::string_view name)
      : of_(of),
        stream_(run.stream(fmt::format("generic.{}", name))),
        scale_(1 + draw(of.scale_factor, stream_)),
        bias_(draw(of.bias, stream_)),
        correlated_(of.correlated * stream_.normal()) {}

  /// The value at `t_us`, `dt` [s] after the one before. None: it is invalid.
  std::optional<double> at(const world::Truths& truths, std::int64_t t_us, double dt) {
    // x' = -x / T + w, in its steady state: x(t + dt) = a x(t) + sqrt(1 - a^2) sigma N(0, 1), a = e^(-dt/T).
    const double a = std::exp(-dt / of_.correlation_s);
    correlated_ = a * correlated_ + std::sqrt(1 - a * a) * of_.correlated * stream_.normal();
    walk_ += of_.random_walk * std::sqrt(dt) * stream_.normal();
    const double white = of_.noise * stream_.normal();
    const auto truth = of_.truth.at(truths, t_us);
    const auto valid = of_.valid ? of_.valid->at(truths, t_us) : 1;
    if (!truth) return std::nullopt;
    const double lagged = lag(*truth, dt);
    if (!valid || *valid == 0) return std::nullopt;
    const double value =
        std::clamp(scale_ * lagged + bias_ + correlated_ + walk_ + white, of_.lowest, of_.highest);
    return of_.quantum > 0 ? of_.quantum * std::round(value / of_.quantum) : value;
  }

 private:
  // y' = 2 pi f (x - y), for an input that is constant between two samples.
  double lag(double input, double dt) {
    if (of_.bandwidth == 0 || !lagged_)
      lagged_ = input;
    else
      *lagged_ += (1 - std::exp(-2 * std::numbers::pi * of_.bandwidth * dt)) * (input - *lagged_);
    return *lagged_;
  }

  GenericValue of_;
  world::Stream stream_;
  double scale_, bias_, correlated_, walk_ = 0;
  std::optional<double> lagged_{};
};

class Generic final : public LossySampler<GenericSettings> {
 public:
  Generic(const NodeSettings& node, const Run& run)
      : LossySampler(node, run, "generic.loss"),
        truths_{.flight = run.flight, .glide = run.glide, .engagement = run.engagement},
        dt_(1e-6 * static_cast<double>(node.period_us())) {
    const auto outputs = node.table().sensor->outputs.values;
    for (std::size_t i = 0; i < outputs.size(); ++i)
      values_.emplace_back(config_.values[i], run, outputs[i].name);
    held_.resize(outputs.size(), 0.0);
  }

 private:
  // While a value is invalid, the last valid one is sent.
  void fill(std::int64_t t_us, Sample& sample) override {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (const auto value = values_[i].at(truths_, t_us, dt_))
        held_[i] = *value;
      else
        sample.invalid |= 1U << i;
      sample.values[i] = held_[i];
    }
  }

  world::Truths truths_;
  double dt_;
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
                             .samples = scenario::TruthOf::navigation,
                             .read = read,
                             .make = make<Generic>,
                             .outputs = {},
                             .period_us = usual_period_us,
                             .only_named = true,
                             .why_no_truth = why_no_truth};

}  // namespace canhil::sensors
