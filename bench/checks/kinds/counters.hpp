// Checks the counters that the target reports last (TargetCounters).
#pragma once

#include <span>

#include "bench/checks/rule.hpp"

namespace canhil::checks {

/// Limits; an absent limit is not judged.
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
  std::optional<std::int64_t> at_most;  ///< none: not judged
  std::uint64_t value = 0;
};
/// Passes if all limits are kept: "bad CRC 0, late 2", expected "bad CRC <= 0, late <= 3".
Finding within_limits(std::span<const CountLimit> limits);

}  // namespace canhil::checks
