// How late a quantity is told, by the truth.
#pragma once

#include "bench/checks/rule.hpp"

namespace canhil::checks {

struct DelayBelow {
  static constexpr std::string_view kind = "delay";
  static constexpr std::string_view meaning =
      "Passes when the delay of the quantity against the truth is below the bar (mapping.md).";
  Subject of;
  scenario::Window window;
  std::int64_t below_us = 0;

  static DelayBelow read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const { return of.words; }
  [[nodiscard]] std::vector<Subject> subjects() const { return {of}; }
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
