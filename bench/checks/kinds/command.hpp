// A check of the times of the target's commands to a plant.
#pragma once

#include <string>

#include "bench/checks/rule.hpp"

namespace canhil::checks {

struct CommandTime {
  static constexpr std::string_view kind = "command";
  static constexpr std::string_view meaning =
      "Passes when the plant never waits long for a new command (`age`), or when commands act soon after the "
      "measurement that they answer (`delay`).";
  enum class Statistic : std::uint8_t { age, delay };

  std::string input{};
  Statistic statistic = Statistic::age;
  double quantile = 1;
  std::int64_t below_us = 0;
  scenario::Window window{};

  static CommandTime read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const;
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
