// Limits the errors that the bench finds in the target's messages: wrong checksums, wrong counters, wrong
// sizes, and lost messages. In every run, a wrong checksum or size fails, and so does a counter that stands
// still or jumps (protection_faults()).
#pragma once

#include "bench/checks/kinds/counters.hpp"
#include "bench/scenario/scenario.hpp"

namespace canhil::checks {

struct Protection {
  static constexpr std::string_view kind = "protection";
  static constexpr std::string_view meaning =
      "Passes when the counters and checksums of the target's messages are as canhil.dbc or the mapping "
      "defines them.";
  std::optional<std::string> message{};  ///< none: all messages of the target
  std::vector<std::string> answers;      ///< messages that must have come
  /// None: 0, for messages that have this protection.
  std::optional<std::int64_t> wrong_checksums_at_most{}, wrong_counters_at_most{}, wrong_sizes_at_most{},
      lost_at_most{};

  static Protection read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const { return message.value_or(""); }
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

/// Reports, in one line, the messages of the target with wrong checksums or sizes, and those whose counters
/// stand still or jump. Jumps are gaps of more frames than the target can have sent, so frames that were lost
/// on the way do not count. Leaves out the messages for which a check of the scenario has limits of its own.
/// Empty: none.
std::string protection_faults(const scenario::Scenario& scenario, const Observations& seen);

}  // namespace canhil::checks
