// Checks that the error of a quantity enters a band before a given time and stays in the band to the end of
// the run.
#pragma once

#include "bench/checks/rule.hpp"
#include "bench/quantities/track.hpp"

namespace canhil::checks {

struct Convergence {
  static constexpr std::string_view kind = "convergence";
  static constexpr std::string_view meaning =
      "Passes when |estimated - true| comes within `within_UNIT` before `before_s` and stays there until the "
      "end of the run.";
  Subject judged;
  double within = 0;  ///< [SI]
  quantities::Unit unit{};
  std::int64_t before_us = 0;
  std::int64_t end_us = 0;  ///< end of the run

  static Convergence read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const { return judged.text; }
  [[nodiscard]] std::vector<Subject> subjects() const { return {judged}; }
  [[nodiscard]] std::optional<Bar> bar() const;
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
