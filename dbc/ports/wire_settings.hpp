// The settings of a simulated wire, which follow the '?' in the name of a bus.
#pragma once

#include <cstdint>
#include <string_view>

#include "dbc/ports/port.hpp"
#include "dbc/ports/simulated_wire.hpp"
#include "dbc/wire/result.hpp"

namespace canhil {

/// The settings in a text such as
/// `bitrate=500000&data-bitrate=2000000&queue=priority&bit-error-rate=1e-6&seed=3`.
struct WireSettings {
  wire::BitRates rates{};               ///< nominal 0: no wire, frames take no time
  QueueOrder order = QueueOrder::fifo;  ///< of every node's queue
  double bit_error_rate = 0;            ///< see BitErrors
  std::uint64_t seed = 1;               ///< of the errors

  /// The facts about the wire that follow from these settings.
  [[nodiscard]] WireFacts facts() const {
    return {.rates = rates, .urgent_first = order == QueueOrder::priority};
  }
};

/// Reads the settings after the first '?' of a bus's name; without a '?' there is no wire. Error: one line
/// with the bus as typed and what was expected.
Result<WireSettings> wire_settings(std::string_view bus);

/// The disturbance of the wire; empty at a bit error rate of 0.
Disturb disturbance(const WireSettings& settings);

}  // namespace canhil
