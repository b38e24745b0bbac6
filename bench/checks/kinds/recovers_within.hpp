// Checks that after the end of a fault the signs of trouble stop for good, answers come, and the error of a
// quantity is small again.
#pragma once

#include "bench/checks/kinds/of_faults.hpp"
#include "bench/quantities/track.hpp"

namespace canhil::checks {

struct RecoversWithin {
  static constexpr std::string_view kind = "recovers_within";
  static constexpr std::string_view meaning =
      "Passes when, at all times later than `within_s` after the end of the fault, there is no sign of the "
      "fault and answers come without a gap (scenarios.md defines the signs).";
  Disturbance disturbance;
  std::int64_t within_us = 0;
  std::vector<std::string> by;     ///< names of signs; empty: any sign that was absent before the fault
  std::optional<Subject> error{};  ///< the quantity whose error must be below `below` again
  double below = 0;                ///< [SI]
  quantities::Unit unit{};
  std::vector<Subject> answering;  ///< the answers must contain these quantities: silence is not recovery

  static RecoversWithin read(scenario::Section& section, const scenario::CheckContext& context);
  [[nodiscard]] std::string subject() const;
  [[nodiscard]] std::vector<Subject> subjects() const;
  [[nodiscard]] std::vector<std::string> held_against_truth() const;
  [[nodiscard]] std::optional<std::int64_t> event_us() const { return disturbance.event_us(); }
  /// The answers after the time that the target has for the recovery.
  [[nodiscard]] Stretch span() const;
  [[nodiscard]] Finding judge(const Evidence& evidence) const;
};

}  // namespace canhil::checks
