// Values that partners of a run put into the samples of sensors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <tuple>

#include "bench/sensors/kind.hpp"

namespace canhil::sensors {

struct Overrides {
  /// A value or a validity flag of a sensor.
  struct Place {
    const Kind* sensor = nullptr;
    Role role = Role::value;
    std::size_t index = 0;
    friend bool operator<(const Place& a, const Place& b) {
      return std::tie(a.sensor, a.role, a.index) < std::tie(b.sensor, b.role, b.index);
    }
  };
  std::map<Place, double> values{};  ///< in SI; of a flag: 0 is invalid
  std::uint64_t samples = 0;         ///< number of samples that were changed
};

/// A sensor whose samples have the values of `overrides`, which must outlive it and counts them.
std::unique_ptr<Sensor> with_overrides(std::unique_ptr<Sensor> sensor, const Kind& kind,
                                       Overrides& overrides);

}  // namespace canhil::sensors
