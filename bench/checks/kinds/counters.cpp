#include "bench/checks/kinds/counters.hpp"

#include <fmt/format.h>

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
  Finding finding{.outcome = Outcome::pass, .measured = "", .expected = ""};
  for (const CountLimit& limit : limits) {
    if (!limit.at_most) continue;
    const std::string_view separator = finding.expected.empty() ? "" : ", ";
    finding.expected += fmt::format("{}{} <= {}", separator, limit.what, *limit.at_most);
    finding.measured += fmt::format("{}{} {}", separator, limit.what, limit.value);
    if (std::cmp_greater(limit.value, *limit.at_most)) finding.outcome = Outcome::fail;
  }
  return finding;
}

Finding Counters::judge(const Evidence& evidence) const {
  if (!evidence.seen.counters) return {Outcome::fail, "no TargetCounters", "counters reported"};
  const messages::TargetCounters& counters = *evidence.seen.counters;
  return within_limits(std::array<CountLimit, 4>{{{"frames lost", frames_lost_at_most, counters.frames_lost},
                                                  {"bad CRC", bad_crc_at_most, counters.bad_crc},
                                                  {"bad groups", bad_group_at_most, counters.bad_group},
                                                  {"late", late_at_most, counters.late}}});
}

}  // namespace canhil::checks
