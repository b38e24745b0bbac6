#include "bench/checks/kinds/counters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "bench/checks/evidence.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::checks {

Counters Counters::read(scenario::Section& section, const scenario::CheckContext& /*context*/) {
  const Counters rule{
      .frames_lost_at_most = section.optional_integer(
          {"frames_lost_at_most", "Maximum number of frames that the target counts as lost."}, 0),
      .bad_crc_at_most = section.optional_integer(
          {"bad_crc_at_most",
           "Maximum number of frames that the target counts as having a wrong CRC or a wrong size."},
          0),
      .bad_group_at_most = section.optional_integer(
          {"bad_group_at_most", "Maximum number of groups that the target counts as incomplete or unusable."},
          0),
      .late_at_most = section.optional_integer({"late_at_most",
                                                "Maximum value of the target's count `late`, which counts "
                                                "late groups and frames with a repeated counter."},
                                               0)};
  if (!rule.frames_lost_at_most && !rule.bad_crc_at_most && !rule.bad_group_at_most && !rule.late_at_most)
    section.reject("frames_lost_at_most", "is missing, as are all other limits", "at least one limit");
  return rule;
}

Finding within_limits(std::span<const CountLimit> limits) {
  Finding finding{.outcome = Outcome::pass, .measured = "", .expected = {}};
  std::vector<Judgement> judgements;
  for (const CountLimit& limit : limits) {
    if (!limit.at_most) continue;
    const std::string_view separator = finding.measured.empty() ? "" : ", ";
    finding.expected.text += fmt::format("{}{} <= {}", separator, limit.what, *limit.at_most);
    finding.measured += fmt::format("{}{} {}", separator, limit.what, limit.value);
    if (std::cmp_greater(limit.value, *limit.at_most)) finding.outcome = Outcome::fail;
    judgements.push_back({.criterion = {.quantity = std::string(limit.what),
                                        .upper = Limit{.value = static_cast<double>(*limit.at_most)}},
                          .measurement = {.value = static_cast<double>(limit.value)}});
  }
  take_nearest_to_limit(finding, std::move(judgements));
  return finding;
}

Finding of_the_whole_run(Finding finding, const Observations& seen) {
  const TargetReports& reports = seen.reports;
  const auto add = [&](Outcome outcome, const std::string& why) {
    finding.measured += "; " + why;
    finding.outcome = outcome;
    finding.measurement = {};  // the counts are those of a part of the run
  };
  if (!reports.went_down().empty()) {
    add(Outcome::fail, "the counts went down: " + reports.went_down());
  } else if (const auto stopped_us = reports.counters_stopped_us()) {
    // While a fault stops the target's process, the target sends nothing.
    const bool held = std::ranges::any_of(seen.faults, [&](const FaultRecord& fault) {
      return fault.of_target && fault.count > 0 && fault.window.to_us >= *stopped_us;
    });
    const std::string away = seen.bus.outages();
    const std::string stopped =
        fmt::format("TargetCounters stopped at {:g} s", static_cast<double>(*stopped_us) * 1e-6);
    if (!away.empty())
      add(Outcome::not_measured, stopped + "; " + away);
    else if (!held)
      add(Outcome::fail, stopped);
  }
  return finding;
}

Finding Counters::judge(const Evidence& evidence) const {
  if (!evidence.seen.counters) return {Outcome::fail, "no TargetCounters", {.text = "counters reported"}};
  const messages::TargetCounters& counters = *evidence.seen.counters;
  Finding finding =
      within_limits(std::array<CountLimit, 4>{{{"frames lost", frames_lost_at_most, counters.frames_lost},
                                               {"bad CRC", bad_crc_at_most, counters.bad_crc},
                                               {"bad groups", bad_group_at_most, counters.bad_group},
                                               {"late", late_at_most, counters.late}}});
  return of_the_whole_run(std::move(finding), evidence.seen);
}

}  // namespace canhil::checks
