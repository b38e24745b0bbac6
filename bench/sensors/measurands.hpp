// The quantities that the sensors measure. They are identified by name and given in SI, independent of any
// DBC: a mapping may send them, and a fault may change them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "bench/sensors/kind.hpp"

namespace canhil::sensors {

/// How the samples of an interval are combined to one value at its end.
enum class Over : std::uint8_t {
  newest,  ///< the newest sample, for a value
  sum,     ///< the sum, for an increment
  rate     ///< the sum of increments divided by the interval
};

/// A measured quantity. Its name is SENSOR.VALUE ("gps.latitude"), or that of the rate of an increment
/// ("imu.rate.z").
struct Measurand {
  std::string name;
  std::string_view si;           ///< SI unit
  const Kind* sensor = nullptr;  ///< required table of the scenario
  std::size_t index = 0;         ///< in the sample's values
  Over over = Over::newest;

  [[nodiscard]] const Output& output() const { return sensor->outputs.values[index]; }
};

/// The measurands of one sensor. Those of a named sensor begin with its name ("imu_b.rate.z").
std::span<const Measurand> measurands_of(const Kind& sensor);
/// The measurands of all kinds, in the order of the sensors.
std::span<const Measurand> measurands();

}  // namespace canhil::sensors
