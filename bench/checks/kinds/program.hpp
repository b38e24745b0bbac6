// A check of the user's own: a program that judges the reports of the run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/checks/rule.hpp"

namespace canhil::checks {

/// report::judge_by_programs() starts the program after the run and puts its judgements in the place of the
/// finding of this rule.
struct Program {
  static constexpr std::string_view kind = "program";
  static constexpr std::string_view meaning =
      "Passes when all judgements of a program of your own pass. The program gets the JSON report and the "
      "CSV "
      "table of the run (scenarios.md).";
  std::string command{};
  std::vector<std::string> words{};  ///< of the command
  std::string folder{};              ///< in which it runs: that of the scenario
  std::int64_t within_us = 0;        ///< wall time until it must have ended

  static Program read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const { return command; }
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
