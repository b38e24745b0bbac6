// Functions that the generated code calls in its codecs and in its static assertions. All generated headers
// include this file.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>

#include "dbc/wire/bits.hpp"
#include "dbc/wire/message_info.hpp"
#include "dbc/wire/quantise.hpp"
#include "dbc/wire/unrounded.hpp"

namespace canhil::wire {

/// True if two conditions hold: every signal is inside the message; and signals that are not multiplexed
/// overlap neither each other nor, in a protected message, the E2E fields.
constexpr bool is_sound(const MessageInfo& message, std::span<const SignalInfo> signals) {
  std::array<bool, 512> taken{};
  if (message.e2e_data_id != 0) std::fill_n(taken.begin(), 12, true);
  for (const SignalInfo& signal : signals) {
    for (unsigned i = 0; i < signal.length; ++i) {
      const unsigned bit = bit_position(signal.start_bit, i, signal.big_endian);
      if (bit >= message.size * 8U || (!signal.multiplexed && taken[bit])) return false;
      if (!signal.multiplexed) taken[bit] = true;
    }
  }
  return true;
}

/// The largest allowed ratio of the rounding noise to the sensor noise: LSB / sqrt(12) <= sigma / 4.
inline constexpr double largest_quantisation_ratio = 0.25;

/// The standard deviation of the error that rounding to multiples of `lsb` causes, divided by the standard
/// deviation `sensor_sigma` of the noise in one sample of the sensor.
constexpr double quantisation_ratio(double lsb, double sensor_sigma) {
  constexpr double sqrt_12 = 3.4641016151377544;
  return lsb / sqrt_12 / sensor_sigma;
}

/// The verdict on the resolution of a measured signal.
enum class Resolution : std::uint8_t {
  enough,
  too_coarse,       ///< LSB / sqrt(12) > sigma / 4
  loses_remainder,  ///< an increment (delta_*) without CarriesRemainder, so rounding errors accumulate
  unknown_sigma     ///< a signal with CarriesRemainder, so a measurement, but without SensorSigma
};

/// Judges the resolution of a signal by its LSB and by the sigma of its sensor, both in the unit of the
/// signal. A sigma of 0 means that the signal is not from a sensor.
constexpr Resolution resolution_of(std::string_view name, double lsb, double sensor_sigma,
                                   bool carries_remainder) {
  if (name.starts_with("delta_") && !carries_remainder) return Resolution::loses_remainder;
  if (sensor_sigma <= 0) return carries_remainder ? Resolution::unknown_sigma : Resolution::enough;
  return quantisation_ratio(lsb, sensor_sigma) <= largest_quantisation_ratio ? Resolution::enough
                                                                             : Resolution::too_coarse;
}

/// True if every signal that is a measurement has enough resolution for its sensor.
constexpr bool is_fine_enough(std::span<const SignalInfo> signals) {
  return std::ranges::all_of(signals, [](const SignalInfo& s) {
    return resolution_of(s.name, lsb(s), s.sensor_sigma, s.carries_remainder) == Resolution::enough;
  });
}

/// The message with this id in a list that is sorted by id; nullptr: the list has no such message.
constexpr const MessageInfo* find(std::span<const MessageInfo> sorted, std::uint32_t id, bool extended) {
  const auto found = std::ranges::lower_bound(sorted, id, {}, &MessageInfo::id);
  for (auto i = found; i != sorted.end() && i->id == id; ++i) {
    if (i->extended == extended) return &*i;
  }
  return nullptr;
}

}  // namespace canhil::wire
