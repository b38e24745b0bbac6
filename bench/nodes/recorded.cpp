#include "bench/nodes/recorded.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "bench/scenario/recorded_flight.hpp"
#include "bench/scenario/table.hpp"

namespace canhil::nodes {
namespace {

// The longest gap accepted by default: 0.2 s, because a longer IMU gap ends an alignment. For a slower node
// it is three periods, because such a node may lack two samples in a row.
std::int64_t usual_gap_us(std::int64_t period_us) { return std::max<std::int64_t>(200'000, 3 * period_us); }

double ms(std::int64_t us) { return 1e-3 * static_cast<double>(us); }

// Checks the period, because silence, freshness and the grid of the truth are computed from it.
Result<void> check_period(std::int64_t median_us, std::int64_t period_us, std::string_view file) {
  constexpr double tolerated = 0.1;
  const auto period = static_cast<double>(period_us);
  if (std::abs(static_cast<double>(median_us) - period) <= tolerated * period) return {};
  return failure(
      fmt::format("{}: samples come every {:g} ms (median), expected every {:g} ms, or 'period_ms = {:g}' "
                  "beside it",
                  file, ms(median_us), ms(period_us), ms(median_us)));
}

Result<void> read_csv(RecordedSettings& own, const NodeTable& table, Section& section,
                      std::int64_t duration_us, std::int64_t period_us) {
  const std::int64_t from_us = scenario::read_from_us(section);
  const std::int64_t gap_us = section
                                  .optional_time_us({"gap_s",
                                                     "CSV only: longest permitted time without a sample. "
                                                     "Default: 0.2 s, or three periods if they are longer."},
                                                    Limits::above(0))
                                  .value_or(usual_gap_us(period_us));
  const auto text = section.read_beside({"recorded",
                                         "File with the samples that the node sends in place of simulated "
                                         "ones: FILE.csv or FILE.log (recorded-data.md)."},
                                        "a CSV file", scenario::most_recorded_bytes);
  if (!text) return {};
  return scenario::read_table(*text, own.recorded_from, columns_of(table))
      .and_then([&](const scenario::Table& rows) {
        return read_samples(table, rows, from_us, gap_us, period_us, duration_us);
      })
      .and_then([&](RecordedSamples samples) {
        std::vector<std::int64_t> valid_us;
        for (const sensors::Sample& sample : samples) valid_us.push_back(sample.valid_us);
        const std::int64_t median_us = scenario::median_step(valid_us);
        own.samples = std::make_shared<const RecordedSamples>(std::move(samples));
        return check_period(median_us, period_us, own.recorded_from);
      });
}

Result<void> read_log(RecordedSettings& own, const NodeTable& table, Section& section,
                      std::int64_t duration_us, std::int64_t period_us) {
  for (const std::string_view key : {"latency_ms", "from_s", "gap_s"})
    section.refuse(key, "has no effect on a log, whose frames are sent when they were",
                   "a CSV file, or no such key");
  if (!section.read_beside({"recorded",
                            "File with the samples that the node sends in place of simulated ones: FILE.csv "
                            "or FILE.log (recorded-data.md)."},
                           "a candump log", scenario::most_recorded_bytes))
    return {};
  return read_frames(table, own.recorded_from, duration_us).and_then([&](LoggedGroup group) {
    own.frames = std::make_shared<const RecordedFrames>(std::move(group.frames));
    return check_period(group.median_us, period_us, own.recorded_from);
  });
}

}  // namespace

NodeSettings read_recorded(const NodeTable& table, Section& section, std::int64_t duration_us) {
  RecordedSettings own;
  own.schedule = read_constant_schedule(section);
  const std::string name = section.text({"recorded",
                                         "File with the samples that the node sends in place of simulated "
                                         "ones: FILE.csv or FILE.log (recorded-data.md)."});
  own.recorded_from = section.beside(name);
  const std::int64_t period_us = own.schedule.period_us.value_or(table.period_us);
  const std::string kind = std::filesystem::path(name).extension().string();
  Result<void> read;
  if (kind == ".csv") {
    read = read_csv(own, table, section, duration_us, period_us);
  } else if (kind == ".log" && table.closes != nullptr) {
    read = read_log(own, table, section, duration_us, period_us);
  } else {
    section.reject("recorded", fmt::format("'{}' is not of a known kind", name),
                   table.closes != nullptr ? "FILE.csv, or FILE.log of candump or --log" : "FILE.csv");
  }
  if (!read) section.reject("recorded", read.error());
  return {table, std::move(own)};
}

}  // namespace canhil::nodes
