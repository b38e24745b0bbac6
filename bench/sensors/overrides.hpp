// Values that partners of a run put into the samples of sensors.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>

#include "bench/sensors/kind.hpp"

namespace canhil::sensors {

struct Overrides {
  std::map<std::pair<const Kind*, Place>, double> values{};  ///< in SI; of a flag: 0 is invalid
  std::uint64_t samples = 0;                                 ///< number of samples that were changed
};

/// A sensor whose samples have the values of `overrides`, which must outlive it and counts them.
std::unique_ptr<Sensor> with_overrides(std::unique_ptr<Sensor> sensor, const Kind& kind,
                                       Overrides& overrides);

}  // namespace canhil::sensors
