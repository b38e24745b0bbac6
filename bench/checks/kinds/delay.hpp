// The delay of a reported quantity, measured against the truth.
#pragma once

#include "bench/checks/rule.hpp"

namespace canhil::checks {

struct DelayBelow {
  static constexpr std::string_view kind = "delay";
  static constexpr std::string_view meaning =
      "Passes when the delay of the quantity relative to the truth is below `below_ms` (mapping.md).";
  Subject judged;
  scenario::Window window;
  std::int64_t below_us = 0;

  static DelayBelow read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const { return judged.text; }
  [[nodiscard]] std::vector<Subject> subjects() const { return {judged}; }
  /// A lag is measured with the latest possible causes too: these make it longer, if anything.
  [[nodiscard]] static std::vector<Subject> paired() { return {}; }
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
