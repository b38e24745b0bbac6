// What a sensor measured at one time. A sample knows no frame: the binding of a DBC says how it is sent.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

namespace canhil::sensors {

inline constexpr std::int64_t never_us = std::numeric_limits<std::int64_t>::max();

/// The names of a sensor's values and of its validity flags, in the order in which a sample has them.
struct Outputs {
  std::span<const std::string_view> values;
  std::span<const std::string_view> flags{};
};

/// A measurement: its values, in SI and radians, and its times.
struct Sample {
  static constexpr std::size_t most_values = 16;
  enum class Fate : std::uint8_t {
    sent,
    lost,  ///< the sensor sends it, but it does not reach the bus: the receiver detects a gap
    none   ///< there is nothing to measure any more
  };

  std::int64_t valid_us = 0;     ///< time of validity
  std::int64_t stamp_us = 0;     ///< time of validity that the sensor reports
  std::int64_t interval_us = 0;  ///< time over which the increments accumulated
  std::array<double, most_values> values{};
  std::uint32_t invalid = 0;  ///< bit i: flag i says 'invalid'
  Fate fate = Fate::sent;
};

}  // namespace canhil::sensors
