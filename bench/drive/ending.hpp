// How a run ended.
#pragma once

#include <cstdint>
#include <string>

namespace canhil::drive {

/// The outcome of driving a schedule.
struct Ending {
  enum class Kind : std::uint8_t {
    completed,
    target_silent,
    target_fault,
    bus_down,
    interrupted,
    not_flown,
    wrong_answers  ///< only in a campaign: the flight was completed, but a check of every run failed
  };
  static constexpr Kind last_kind = Kind::wrong_answers;
  Kind kind = Kind::completed;
  std::int64_t t_us = 0;  ///< bench time of the end, or the time since which the target was silent
  std::string detail;     ///< one line for people; empty when completed
};

}  // namespace canhil::drive
