// Checks that a statistic of a quantity's error, |estimated - true|, is below a limit in a stretch of the
// run.
#pragma once

#include "bench/checks/rule.hpp"
#include "bench/quantities/quantity.hpp"

namespace canhil::checks {

struct Error {
  static constexpr std::string_view kind = "error";
  static constexpr std::string_view meaning =
      "Passes when the statistic of |estimated - true| in the window is below `below_UNIT`.";
  enum class Statistic : std::uint8_t { max, rms, mean, final };
  Subject judged;  ///< if the quantity has parts, the norm of the parts is judged
  Statistic statistic = Statistic::max;
  Stretch stretch;
  double below = 0;  ///< [SI]
  quantities::Unit unit{};

  static Error read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const;
  [[nodiscard]] std::vector<Subject> subjects() const { return {judged}; }
  [[nodiscard]] std::optional<Bar> bar() const;
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

std::string_view name(Error::Statistic statistic);

}  // namespace canhil::checks
