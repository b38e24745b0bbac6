#include "bench/checks/target_state.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace canhil::checks {
namespace {

// A target bridges a gap between samples of at most this length; after a longer gap it may report
// input_silent.
constexpr std::int64_t bridged_us = 200'000;

bool input_was_lost(const Observations& seen) {
  const auto any = [](const auto& counts) {
    return counts.frames_lost > 0 || counts.bad_crc > 0 || counts.bad_group > 0;
  };
  // If only the target counts losses, the checks of its counters judge them.
  return any(seen.expected_counts.most) || (seen.counters && any(*seen.counters));
}

// If no model observed the run, a gap of any length is possible.
bool input_was_silent(const Observations& seen) {
  const bool gap = !seen.longest_input_gap_us || *seen.longest_input_gap_us > bridged_us;
  return gap || seen.timing.lateness.max_ns() > bridged_us * 1000;
}

bool is_explained(const Report& report, const Observations& seen, std::span<const std::int64_t> events_us) {
  constexpr std::string_view lost = "input_lost", silent = "input_silent", numeric = "numeric";
  if (report.of == Report::Of::state) return report.what == name_of(messages::TargetState::fault);
  if (report.of == Report::Of::identity) return false;
  if (report.what != lost && report.what != silent && report.what != numeric) return false;
  const bool by_fault = std::ranges::any_of(seen.faults, [&](const FaultRecord& fault) {
    return fault.count > 0 && fault.window.from_us <= report.t_us;
  });
  const bool by_event =
      std::ranges::any_of(events_us, [&](std::int64_t t_us) { return t_us <= report.t_us; });
  const bool by_outage = !seen.bus.outages().empty();
  return by_fault || by_event || (report.what != numeric && by_outage) ||
         (report.what == lost && (input_was_lost(seen) || input_was_silent(seen))) ||
         (report.what == silent && input_was_silent(seen));
}

}  // namespace

std::string unexplained_state(const Observations& seen, std::span<const std::int64_t> events_us) {
  const std::vector<Report>& reports = seen.reports.reports();
  const auto ends_the_run = [](const Report& report) {
    return report.of == Report::Of::state && report.what == name_of(messages::TargetState::fault);
  };
  // The errors of a heartbeat that reports a fault are the reason for the end of the run.
  if (std::ranges::any_of(reports, ends_the_run)) return "";
  std::string line;
  const auto add = [&](const std::string& part) { line += (line.empty() ? "" : ", ") + part; };
  for (const Report& report : reports) {
    if (is_explained(report, seen, events_us)) continue;
    add(fmt::format("{}{} {} from {:g} s", report.of == Report::Of::error ? "error " : "", report.estimator,
                    report.what, static_cast<double>(report.t_us) * 1e-6));
  }
  if (!seen.reports.went_down().empty()) add("counts went down: " + seen.reports.went_down());
  return line;
}

}  // namespace canhil::checks
