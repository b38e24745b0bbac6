// The missile's seeker, until the closest approach, and the guidance computer, which can use the target's
// answers.
#pragma once

#include <optional>
#include <utility>

#include "bench/scenario/schedule.hpp"
#include "bench/sensors/seeker_errors.hpp"

namespace canhil::sensors {

/// The table [seeker].
struct SeekerSettings {
  scenario::Schedule schedule{};
  std::int64_t jitter_us = 0;  ///< added to the latency of each sample: uniform from 0 to this value
  SeekerErrorModel errors{};
  double loss_probability = 0;           ///< a group is not sent, and its increments are lost
  double invalid_probability = 0;        ///< a missed radar pulse: the error angles of a group are invalid
  double invalid_range_probability = 0;  ///< range and closing speed of a group are invalid
  std::optional<std::pair<std::int64_t, std::int64_t>> blackout_us{};  ///< error angles are invalid
};

extern const struct Kind seeker;

}  // namespace canhil::sensors
