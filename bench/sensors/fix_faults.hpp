// Faults of the fixes of an aiding node.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "bench/scenario/node.hpp"
#include "bench/scenario/section.hpp"
#include "bench/world/stream.hpp"

namespace canhil::sensors {

/// Faults that affect each fix independently; all probabilities in [0, 1].
struct FixFaults {
  double loss_probability = 0;     ///< the group of a fix is not sent
  double invalid_probability = 0;  ///< the fix is sent, but flagged invalid
  double outlier_probability = 0;
  double outlier = 0;  ///< horizontal size of an outlier [m]
  std::optional<std::pair<std::int64_t, std::int64_t>>
      silence_us{};  ///< a fix with a time of validity in this interval is not sent
};

/// The keys loss_percent, invalid_percent, outlier_percent, outlier_m and silence_s of a node's table.
FixFaults read_fix_faults(scenario::Section& section);

/// The fraction of a node's fixes that need not be answered. `Own`: the type of the node's settings, with a
/// member `faults`.
template <class Own>
double lost_fixes(const scenario::NodeSettings& node) {
  if (!node.is_modelled()) return 0;  // the losses are unknown: expect answers to all
  const FixFaults& faults = node.own<Own>()->faults;
  return 1 - (1 - faults.loss_probability) * (1 - faults.invalid_probability);
}

/// The drawn faults of one fix.
struct Fate {
  bool lost = false;     ///< its group is not sent
  bool invalid = false;  ///< sent, but flagged
  world::Vector3 jump =
      world::Vector3::Zero();  ///< horizontal offset of an outlier in a random direction [m]
};

/// Draws the faults of the fix that is valid at `valid_us`. Every call takes four numbers from the stream,
/// whatever the settings are.
Fate draw_fate(const FixFaults& faults, std::int64_t valid_us, world::Stream& stream);

}  // namespace canhil::sensors
