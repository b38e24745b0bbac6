// How a run ended.
#pragma once

#include <cstdint>
#include <string>

namespace canhil::drive {

/// Outcome of driving a schedule to its end.
struct Ending {
  enum class Kind : std::uint8_t { completed, target_silent, target_fault, bus_down, interrupted, not_flown };
  static constexpr Kind last_kind = Kind::not_flown;
  Kind kind = Kind::completed;
  std::int64_t t_us = 0;  ///< bench time at which it ended, or since when the target was silent
  std::string detail;     ///< one line for a person; empty when completed
};

}  // namespace canhil::drive
