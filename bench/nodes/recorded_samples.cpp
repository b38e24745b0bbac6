// Samples of a table, and the node that sends them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "bench/nodes/recorded.hpp"
#include "bench/nodes/registry.hpp"
#include "bench/scenario/table.hpp"
#include "dbc/wire/turns.hpp"

namespace canhil::nodes {
namespace {

using scenario::Table;
using sensors::Role;

constexpr std::size_t time_column = 0;

double seconds(std::int64_t us) { return 1e-6 * static_cast<double>(us); }

/// The source of a signal's value.
struct Source {
  const SampleSignal* signal = nullptr;
  std::optional<std::size_t> column{};  ///< index in the table's names; none: constant
  std::optional<std::size_t> rate{};    ///< index of a rate, which is multiplied by the interval
  double constant = 0;
};

bool is_measured(const SampleSignal& signal) {
  return signal.role == Role::validity || signal.role == Role::value;
}

const sensors::Output* output_of(const Kind& kind, const SampleSignal& signal) {
  return signal.role == Role::value ? &kind.table.sensor->outputs.values[signal.index] : nullptr;
}

std::optional<double> assumed(const SampleSignal& signal, const sensors::Output* output) {
  if (signal.role == Role::validity) return static_cast<double>(messages::Validity::valid);
  return output->assumed;
}

Result<std::vector<Source>> sources_of(const Kind& kind, const Table& rows) {
  if (!rows.has(time_column)) return tl::unexpected(rows.missing(time_column));
  std::vector<Source> sources;
  std::size_t column = time_column + 1;
  for (const SampleSignal& signal : kind.signals) {
    Source source{.signal = &signal};
    if (is_measured(signal)) {
      const sensors::Output* output = output_of(kind, signal);
      const bool adds_up = output != nullptr && !output->rate.empty();
      const std::size_t own = column++;
      const std::optional<std::size_t> rate = adds_up ? std::optional(column++) : std::nullopt;
      const bool has_rate = rate && rows.has(*rate);
      if (has_rate && rows.has(own))
        return failure(fmt::format("{}:1: column '{}': is given beside '{}', expected one of the two",
                                   rows.file, rows.found[*rate], rows.found[own]));
      if (rows.has(own)) {
        source.column = own;
      } else if (has_rate) {
        source.rate = rate;
      } else if (const auto value = assumed(signal, output)) {
        source.constant = *value;
      } else {
        Error error = rows.missing(own);
        if (adds_up) error.message += fmt::format(", or '{}', its rate", output->rate_column);
        return tl::unexpected(std::move(error));
      }
    }
    sources.push_back(source);
  }
  return sources;
}

/// The rows whose times of validity are after the start of the run and not after its end. Rows::last is the
/// index after the last of these rows. It is an error if a gap between samples is too long.
Result<scenario::Rows> within_run(const Table& table, const std::vector<std::int64_t>& t_us,
                                  std::int64_t gap_us, std::int64_t end_us) {
  scenario::Rows rows;
  rows.first = static_cast<std::size_t>(std::ranges::upper_bound(t_us, 0) - t_us.begin());
  rows.last = static_cast<std::size_t>(std::ranges::upper_bound(t_us, end_us) - t_us.begin());
  const auto silent = [&](std::size_t row, std::int64_t from_us, std::int64_t to_us) {
    return tl::unexpected(table.about(
        std::min(row, table.rows() - 1), time_column,
        fmt::format("no sample from {:g} to {:g} s of the run, expected at most {:g} s without (key 'gap_s'; "
                    "'from_s' says where the run begins)",
                    seconds(from_us), seconds(to_us), seconds(gap_us))));
  };
  std::int64_t before_us = 0;
  for (std::size_t row = rows.first; row < rows.last; ++row) {
    if (t_us[row] - before_us > gap_us) return silent(row, before_us, t_us[row]);
    before_us = t_us[row];
  }
  if (end_us - before_us > gap_us || rows.last - rows.first < 2) return silent(rows.last, before_us, end_us);
  return rows;
}

/// A value of a row in the unit of its signal.
Result<double> value_of(const Source& source, const Table& table, std::size_t row, double interval) {
  if (!source.column && !source.rate) return source.constant;
  const std::size_t index = source.column ? *source.column : *source.rate;
  double value = table.value(row, index) * (source.rate ? interval : 1);
  const SignalInfo& signal = source.signal->info;
  if (wire::turns(signal)) value = std::remainder(value, 360);
  if (value < signal.minimum || value > signal.maximum)
    return tl::unexpected(
        table.about(row, index,
                    fmt::format("{:g} {} does not fit into signal {}, expected {:g} to {:g}", value,
                                signal.unit, signal.name, signal.minimum, signal.maximum)));
  return value;
}

/// The interval from the previous sample to this sample, rounded to the steps of its signal so that rounding
/// errors do not accumulate. If samples are missing before this sample, the interval is one period, so that
/// the target can detect the gap.
std::int64_t interval_of(const std::vector<std::int64_t>& t_us, std::size_t row, std::int64_t period_us,
                         double step_us) {
  if (row == 0 || 2 * (t_us[row] - t_us[row - 1]) > 3 * period_us) return period_us;
  const auto whole = [&](std::int64_t t) {
    return std::llround(std::nearbyint(static_cast<double>(t) / step_us) * step_us);
  };
  return whole(t_us[row]) - whole(t_us[row - 1]);
}

class Samples final : public sensors::Sensor {
 public:
  Samples(const NodeSettings& node, const Run& run)
      : samples_(node.own<RecordedSettings>()->samples),
        latency_us_(node.latency_us()),
        end_us_(run.flight.end_us()) {}

  [[nodiscard]] std::int64_t due_us() const override {
    if (next_ == samples_->size()) return never_us;
    const std::int64_t due_us = (*samples_)[next_].valid_us + latency_us_;
    return due_us > end_us_ ? never_us : due_us;
  }
  sensors::Sample measure() override { return (*samples_)[next_++]; }

 private:
  std::shared_ptr<const RecordedSamples> samples_;
  std::int64_t latency_us_;
  std::int64_t end_us_;
  std::size_t next_ = 0;
};

}  // namespace

std::vector<std::string> columns_of(const NodeTable& table) {
  std::vector<std::string> names{"t_s"};
  const Kind& kind = kind_of(table);
  for (const SampleSignal& signal : kind.signals) {
    if (!is_measured(signal)) continue;
    names.emplace_back(signal.info.name);
    const sensors::Output* output = output_of(kind, signal);
    if (output != nullptr && !output->rate.empty()) names.emplace_back(output->rate_column);
  }
  return names;
}

Result<RecordedSamples> read_samples(const NodeTable& table, const Table& rows, std::int64_t from_us,
                                     std::int64_t gap_us, std::int64_t period_us, std::int64_t end_us) {
  const auto sources = sources_of(kind_of(table), rows);
  if (!sources) return tl::unexpected(sources.error());
  const auto t_us = scenario::times_of(rows, time_column, from_us);
  if (!t_us) return tl::unexpected(t_us.error());
  const auto part = within_run(rows, *t_us, gap_us, end_us);
  if (!part) return tl::unexpected(part.error());
  const auto interval =
      std::ranges::find(*sources, Role::interval, [](const Source& source) { return source.signal->role; });
  const bool has_interval = interval != sources->end();
  const double step_us = has_interval ? wire::lsb(interval->signal->info) : 1;
  RecordedSamples samples;
  for (std::size_t row = part->first; row < part->last; ++row) {
    sensors::Sample& sample = samples.emplace_back();
    sample.valid_us = sample.stamp_us = (*t_us)[row];
    sample.interval_us = static_cast<double>(interval_of(*t_us, row, period_us, step_us));
    if (has_interval && sample.interval_us > interval->signal->info.maximum)
      return tl::unexpected(rows.about(
          row, time_column,
          fmt::format("{:g} us since the row before do not fit into signal {}, expected at most {:g}",
                      sample.interval_us, interval->signal->info.name, interval->signal->info.maximum)));
    for (const Source& source : *sources) {
      const auto value = value_of(source, rows, row, 1e-6 * sample.interval_us);
      if (!value) return tl::unexpected(value.error());
      const SampleSignal& signal = *source.signal;
      if (signal.role == Role::value) sample.values[signal.index] = *value * signal.factor;
      if (signal.role == Role::validity && *value == 0) sample.invalid |= 1U << signal.index;
    }
  }
  return samples;
}

std::unique_ptr<sensors::Sensor> make_recorded(const NodeSettings& node, const Run& run) {
  if (node.own<RecordedSettings>()->frames) return make_logged(node, run);
  return std::make_unique<Samples>(node, run);
}

}  // namespace canhil::nodes
