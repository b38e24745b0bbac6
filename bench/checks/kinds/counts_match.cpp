#include "bench/checks/kinds/counts_match.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "bench/checks/evidence.hpp"
#include "bench/checks/kinds/counters.hpp"
#include "bench/scenario/section.hpp"

namespace canhil::checks {
namespace {

// The counters saturate at this value.
std::uint64_t largest() {
  const auto signals = messages::TargetCounters::signals();
  return static_cast<std::uint64_t>(std::ranges::max_element(signals, {}, &SignalInfo::maximum)->maximum);
}

struct Count {
  std::string_view what;
  std::uint64_t reported = 0;
  std::uint64_t least = 0, most = 0;
};

Count count(std::string_view what, std::uint64_t reported, std::uint64_t least, std::uint64_t most,
            std::int64_t slack) {
  const auto room = static_cast<std::uint64_t>(slack);
  const std::uint64_t saturated_at = largest();
  return {.what = what,
          .reported = reported,
          .least = std::min(least - std::min(least, room), saturated_at),
          .most = std::min(most + room, saturated_at)};
}

}  // namespace

CountsMatch CountsMatch::read(scenario::Section& section, const scenario::CheckContext& /*context*/) {
  const auto slack = [&](std::string_view key, std::string_view meaning) {
    return section.optional_integer({key, meaning}, 0).value_or(0);
  };
  return {.frames_lost_slack =
              slack("frames_lost_slack", "Tolerance for the count of lost frames; 0 if not given."),
          .bad_crc_slack =
              slack("bad_crc_slack",
                    "Tolerance for the count of frames with a wrong CRC or a wrong size; 0 if not given."),
          .bad_group_slack = slack(
              "bad_group_slack", "Tolerance for the count of incomplete or unusable groups; 0 if not given."),
          .late_slack = slack(
              "late_slack",
              "Tolerance for the count of late groups and frames with a repeated counter; 0 if not given.")};
}

Finding CountsMatch::judge(const Evidence& evidence) const {
  const Observations& seen = evidence.seen;
  if (!seen.counters)
    return {Outcome::fail, "no TargetCounters", {.text = "counts of what the bench withheld"}};
  const auto& [least, most] = seen.expected_counts;
  const std::array counts{
      count("frames lost", seen.counters->frames_lost, least.frames_lost, most.frames_lost,
            frames_lost_slack),
      count("bad CRC", seen.counters->bad_crc, least.bad_crc, most.bad_crc, bad_crc_slack),
      count("bad groups", seen.counters->bad_group, least.bad_group, most.bad_group, bad_group_slack),
      count("late", seen.counters->late, least.late, most.late, late_slack)};
  Finding finding{.outcome = Outcome::pass, .measured = "", .expected = {}};
  std::vector<Judgement> judgements;
  for (const Count& one : counts) {
    const std::string_view separator = finding.measured.empty() ? "" : ", ";
    finding.measured += fmt::format("{}{} {}", separator, one.what, one.reported);
    finding.expected.text += fmt::format("{}{} {}", separator, one.what, one.least);
    if (one.most > one.least) finding.expected.text += fmt::format(" to {}", one.most);
    if (one.reported < one.least || one.reported > one.most) finding.outcome = Outcome::fail;
    judgements.push_back({.criterion = {.quantity = std::string(one.what),
                                        .lower = Limit{.value = static_cast<double>(one.least)},
                                        .upper = Limit{.value = static_cast<double>(one.most)}},
                          .measurement = {.value = static_cast<double>(one.reported)}});
  }
  finding.expected.text += ", as the bench withheld and damaged";
  take_nearest_to_limit(finding, std::move(judgements));
  // If an outage of the bus lost frames, the target counts these frames too, although the bench did not
  // withhold them.
  if (const std::string away = seen.bus.outages(); finding.outcome == Outcome::fail && !away.empty()) {
    finding.outcome = Outcome::not_measured;
    finding.measured += "; " + away;
  }
  return of_the_whole_run(std::move(finding), seen);
}

}  // namespace canhil::checks
