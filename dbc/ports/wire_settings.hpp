// The settings of a simulated wire, which follow the '?' in the name of a bus.
#pragma once

#include <cstdint>
#include <string_view>

#include "dbc/ports/port.hpp"
#include "dbc/ports/simulated_wire.hpp"
#include "dbc/wire/result.hpp"

namespace canhil {

/// The settings that a text such as
/// `bitrate=500000&data-bitrate=2000000&queue=priority&bit-error-rate=1e-6&seed=3` contains.
struct WireSettings {
  wire::BitRates rates{};               ///< if nominal is 0, there is no wire and frames take no time
  QueueOrder order = QueueOrder::fifo;  ///< order of the queue of every node
  double bit_error_rate = 0;            ///< see BitErrors
  std::uint64_t seed = 1;               ///< seed of the bit errors

  /// The properties of the wire that follow from these settings.
  [[nodiscard]] WireFacts facts() const {
    return {.rates = rates, .urgent_first = order == QueueOrder::priority};
  }
};

/// Reads the settings after the first '?' in the name of a bus. If there is no '?', there is no wire. An
/// error is one line with the bus as the user typed it, and with what was expected.
Result<WireSettings> wire_settings(std::string_view bus);

/// The function that injects the bit errors; an empty function if the bit error rate is 0.
Disturb disturbance(const WireSettings& settings);

}  // namespace canhil
