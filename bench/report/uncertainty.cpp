#include "bench/report/uncertainty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bench/checks/timing.hpp"
#include "bench/report/summary.hpp"

namespace canhil::report {
namespace {

constexpr double kernel_stamp_s = 1e-9;       // SCM_TIMESTAMPNS
constexpr double hardware_stamp_s = 1e-6;     // the coarsest counter of the drivers in use
constexpr double kernel_clock_rate = 500e-6;  // largest rate error of an adjusted clock, adjtimex(2)
constexpr double crystal_rate = 100e-6;

struct Quantile {
  std::string_view name;
  double checks::Distribution::*value;
  bool exact;
};
constexpr std::array<Quantile, 5> quantiles{{{"p50", &checks::Distribution::p50, false},
                                             {"p90", &checks::Distribution::p90, false},
                                             {"p99", &checks::Distribution::p99, false},
                                             {"p999", &checks::Distribution::p999, false},
                                             {"max", &checks::Distribution::max, true}}};

// USB moves data once a millisecond at full speed, and every 125 us at high speed or above.
double poll_s(double usb_mbitps) { return usb_mbitps <= 0 ? 0 : usb_mbitps < 480 ? 1e-3 : 125e-6; }

}  // namespace

StampConditions stamp_conditions(const drive::Run& run) {
  StampConditions conditions{
      .hardware = checks::stamped_by_hardware(run.seen.timing),
      .simulated_wire = run.options.bus.wire && run.options.bus.wire->rates.nominal > 0,
      .echoed = run.seen.transmit_stamps_echoed};
  const std::int64_t bitps = run.seen.bit_rates.nominal;
  if (bitps > 0) conditions.bit_s = 1 / static_cast<double>(bitps);
  for (const drive::Adapter& adapter : run.adapters) {
    if (adapter.kind == "virtual") continue;
    conditions.wire_unknown = bitps == 0;
    if (!conditions.hardware)
      conditions.usb_poll_s = std::max(conditions.usb_poll_s, poll_s(adapter.usb_mbitps));
  }
  return conditions;
}

std::array<double, 5> half_widths_s(const StampConditions& conditions, double latency_s, double lateness_s,
                                    double bucket_s) {
  const bool computed = conditions.simulated_wire;
  const double resolution_s =
      conditions.hardware ? hardware_stamp_s : std::max(kernel_stamp_s, conditions.usb_poll_s);
  const double rate = conditions.hardware ? crystal_rate : kernel_clock_rate;
  // Each of the two stamps is late by between 0 and the bench's own lateness, so their difference has an
  // error of at most this lateness in either direction. The stamps of controllers and of simulated wires do
  // not depend on the host.
  const double host_s = conditions.hardware || computed ? 0 : lateness_s;
  return {resolution_s / 2, rate * latency_s, host_s, conditions.bit_s, bucket_s / 2};
}

double standard_s(Influence influence, double half_width_s) {
  const double stamps = influence == Influence::stamps ? 2 : 1;
  return half_width_s * std::sqrt(stamps / 3);
}

double combined_s(const std::array<double, 5>& half_widths_s) {
  double squares = 0;
  for (std::size_t i = 0; i < half_widths_s.size(); ++i) {
    const double u = standard_s(static_cast<Influence>(i), half_widths_s[i]);
    squares += u * u;
  }
  return std::sqrt(squares);
}

std::vector<UncertainLatency> uncertainties(const scenario::Scenario& scenario, const drive::Run& run) {
  std::vector<UncertainLatency> all;
  if (run.clock != drive::ClockKind::real_time) return all;
  const checks::TimingRecord& timing = run.seen.timing;
  const StampConditions conditions = stamp_conditions(run);
  const checks::Distribution lateness = checks::distribution_s(timing.lateness);
  for (const std::string_view message : closing_answers(scenario)) {
    const auto found = std::ranges::find(timing.messages, message, &MessageInfo::name);
    if (found == timing.messages.end()) continue;
    const auto index = static_cast<std::size_t>(found - timing.messages.begin());
    const checks::Distribution latency = checks::distribution_s(timing.answers[index].latency);
    if (latency.count == 0) continue;
    UncertainLatency one{.message = std::string(message), .figures = {}};
    for (const Quantile& quantile : quantiles) {
      const double value_s = latency.*quantile.value;
      const auto from_us = static_cast<std::int64_t>(value_s * 1e6);
      const double bucket_s =
          quantile.exact ? 0 : 1e-6 * static_cast<double>(checks::bucket_width_us(from_us));
      UncertainFigure figure{.name = quantile.name, .value_s = value_s};
      figure.half_width_s = half_widths_s(conditions, value_s, lateness.*quantile.value, bucket_s);
      figure.expanded_s = coverage_factor * combined_s(figure.half_width_s);
      one.figures.push_back(figure);
    }
    all.push_back(std::move(one));
  }
  return all;
}

std::vector<std::string> left_out(const StampConditions& conditions) {
  std::vector<std::string> lines;
  if (conditions.wire_unknown) lines.emplace_back("the wire: its bit rate is not known");
  if (!conditions.echoed)
    lines.emplace_back("the stimulus's way to the bus: the bench stamped it, and the bus echoed nothing");
  return lines;
}

std::string uncertainty_text(const scenario::Scenario& scenario, const drive::Run& run) {
  std::string lines;
  for (const UncertainLatency& one : uncertainties(scenario, run)) {
    std::string figures;
    for (const UncertainFigure& figure : one.figures) {
      if (figure.name == "p50" || figure.name == "p99" || figure.name == "max")
        figures += fmt::format("  {} ±{:.3f}", figure.name, figure.expanded_s * 1e3);
    }
    lines += fmt::format("  uncertainty {:<18}{} ms  (k = {:g})\n", one.message, figures, coverage_factor);
  }
  if (lines.empty()) return lines;
  for (const std::string& what : left_out(stamp_conditions(run)))
    lines += fmt::format("    without {}\n", what);
  return lines;
}

}  // namespace canhil::report
