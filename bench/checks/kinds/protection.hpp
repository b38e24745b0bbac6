// Limits the errors that the bench finds in the target's messages: wrong checksums, wrong counters, wrong
// sizes, and lost messages.
#pragma once

#include "bench/checks/kinds/counters.hpp"

namespace canhil::checks {

struct Protection {
  static constexpr std::string_view kind = "protection";
  static constexpr std::string_view meaning =
      "Only for a target with a mapping. Passes when the counters and checksums of the target's messages are "
      "as the mapping defines them.";
  std::optional<std::string> message{};  ///< none: all messages of the target
  std::int64_t wrong_checksums_at_most = 0, wrong_counters_at_most = 0, wrong_sizes_at_most = 0,
               lost_at_most = 0;

  static Protection read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const { return message.value_or(""); }
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
