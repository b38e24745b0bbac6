// How a run ended.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace canhil::drive {

/// If waiting for the target is pointless, for example because its process ended, returns the reason.
using Gone = std::function<std::optional<std::string>()>;
inline std::optional<std::string> never_gone() { return std::nullopt; }

/// The outcome of driving a schedule.
struct Ending {
  enum class Kind : std::uint8_t {
    completed,
    target_silent,
    target_fault,
    bus_down,
    interrupted,
    not_flown,
    target_ended,   ///< the process of the target ended during the flight
    wrong_end,      ///< the flight was completed, but the process of the target did not end as it should
    wrong_answers,  ///< only in a campaign: the flight was completed, but a check of every run failed
    not_measured,   ///< only in a campaign: the flight was completed, but the bench could not judge it, for
                    ///< example because it clipped a stimulus or because of a second target
    plant_failed    ///< the plant could not advance
  };
  static constexpr Kind last_kind = Kind::plant_failed;
  Kind kind = Kind::completed;
  std::int64_t t_us = 0;  ///< bench time of the end, or the time since which the target was silent
  std::string detail;     ///< one line for people; empty when completed
};

/// `why`: what a Gone returned.
Ending gone_at(std::int64_t t_us, const std::string& why);

}  // namespace canhil::drive
