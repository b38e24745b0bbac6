// Checks the last values of the counters that the target reports (TargetCounters).
#pragma once

#include <span>

#include "bench/checks/rule.hpp"

namespace canhil::checks {

struct Observations;

/// Limits of the counters; a counter without a limit is not judged.
struct Counters {
  static constexpr std::string_view kind = "counters";
  static constexpr std::string_view meaning =
      "Passes when the target's own counters are within the limits; at least one limit is needed.";
  std::optional<std::int64_t> frames_lost_at_most{}, bad_crc_at_most{}, bad_group_at_most{}, late_at_most{};

  static Counters read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

struct CountLimit {
  std::string_view what;
  std::optional<std::int64_t> at_most;  ///< none: the count is not judged
  std::uint64_t value = 0;
};
/// Passes if no count exceeds its limit. The finding contains two texts, for example "bad CRC 0, late 2" as
/// the measured values and "bad CRC <= 0, late <= 3" as the expected values.
Finding within_limits(std::span<const CountLimit> limits);

/// The finding, unless the last TargetCounters does not give the counts of the whole run: if a count went
/// down, or if TargetCounters stopped before the end, the finding does not pass.
Finding of_the_whole_run(Finding finding, const Observations& seen);

}  // namespace canhil::checks
