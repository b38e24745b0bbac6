// The missile's seeker with the guidance computer that flies on what the target makes of its samples. Sends
// the group Seeker until the closest approach and records what was flown.
#pragma once

#include <optional>
#include <utility>

#include "bench/scenario/schedule.hpp"
#include "bench/world/engagement/seeker_errors.hpp"

namespace canhil::nodes {

/// The table [seeker].
struct SeekerSettings {
  scenario::Schedule schedule{};
  std::int64_t jitter_us = 0;  ///< added to the latency: uniform from 0 to this, drawn for each sample
  world::SeekerErrorModel errors{};
  double loss_probability = 0;           ///< of each group: not sent, its increments are gone
  double invalid_probability = 0;        ///< of the error angles of each group: a pulse that was not received
  double invalid_range_probability = 0;  ///< of range and closing speed of each group
  std::optional<std::pair<std::int64_t, std::int64_t>> blackout_us{};  ///< error angles invalid throughout
};

extern const struct Kind seeker;

}  // namespace canhil::nodes
