// What a sensor measured at one time. A sample knows no frame: the binding of a DBC says how it is sent.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

namespace canhil::sensors {

inline constexpr std::int64_t never_us = std::numeric_limits<std::int64_t>::max();

/// The unit of a measured plain number, such as a ratio.
inline constexpr std::string_view plain_number = "1";

/// A value of a sensor's samples.
struct Output {
  std::string_view name;    ///< "latitude"
  std::string_view si{};    ///< SI unit; empty: a number that is no measured quantity
  bool turns = false;       ///< an angle: values that differ by a full turn are equal
  std::uint32_t flags = 1;  ///< bit i: flag i says whether this value is valid
  /// For an increment, which can be summed over several samples: the name of its rate as a quantity
  /// ("imu.rate.x"), and as a column of a recording ("rate_x_radps").
  std::string_view rate{}, rate_column{};
  /// What is sent if a recording lacks the value.
  std::optional<double> assumed{};
};

/// The values of a sensor and the names of its validity flags, in the order in which a sample has them.
struct Outputs {
  std::span<const Output> values;
  std::span<const std::string_view> flags{};
};

/// What a number of a sample is.
enum class Role : std::uint8_t { time_of_validity, interval, validity, value };

/// A value or a validity flag of a sensor's samples.
struct Place {
  Role role = Role::value;
  std::size_t index = 0;
  friend auto operator<=>(const Place&, const Place&) = default;
};
/// The place of a name: that of a value, or "valid.FLAG". None: the sensor has none of this name.
std::optional<Place> place_of(const Outputs& outputs, std::string_view name);

/// A measurement: its values, in SI and radians, and its times.
struct Sample {
  static constexpr std::size_t most_values = 16;
  enum class Fate : std::uint8_t {
    sent,
    lost,  ///< the sensor sends it, but it does not reach the bus: the receiver detects a gap
    none   ///< the sensor sends nothing: no receiver can detect that a sample is missing
  };

  std::int64_t valid_us = 0;  ///< time of validity
  std::int64_t stamp_us = 0;  ///< time of validity that the sensor reports
  double interval_us = 0;     ///< time over which the increments accumulated
  std::array<double, most_values> values{};
  std::uint32_t invalid = 0;  ///< bit i: flag i says 'invalid'
  Fate fate = Fate::sent;
  bool restarted = false;  ///< the first sample after a restart of the node: its counters begin anew
};

}  // namespace canhil::sensors
