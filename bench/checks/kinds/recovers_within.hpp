// After the end of a fault the signs of trouble go, for good, and the error of a quantity is small again.
#pragma once

#include "bench/checks/kinds/of_faults.hpp"
#include "bench/quantities/track.hpp"

namespace canhil::checks {

struct RecoversWithin {
  static constexpr std::string_view kind = "recovers_within";
  static constexpr std::string_view meaning =
      "Passes when no sign comes any more soon enough after the end, and answers do.";
  Disturbance of;
  std::int64_t within_us = 0;
  std::vector<std::string> by;     ///< names of signs; empty: any that was not there before the fault
  std::optional<Subject> error{};  ///< whose error is to be below again
  double below = 0;                ///< [SI]
  quantities::Unit unit{};
  std::vector<Subject> answering;  ///< of what silence is none that recovers

  static RecoversWithin read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const;
  [[nodiscard]] std::vector<Subject> subjects() const;
  [[nodiscard]] std::vector<std::string> held_against_truth() const;
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
