// The bus load of a run.
#pragma once

#include <span>
#include <string>

#include "bench/checks/observations.hpp"

namespace canhil::checks {

/// Fractions of the time in which the bus is busy: 1 is a full bus.
struct Load {
  double mean = 0;
  double busiest = 0;  ///< in the busiest second
};

/// Bits on the bus in each second. The second in which the run ended is incomplete and left out, unless it is
/// the only one.
std::span<const wire::BitLength> whole_seconds(const Observations& seen);

/// Over the whole_seconds() of a run, at a bit rate [bit/s].
Load bus_load(const Observations& seen, wire::BitRates rates);

/// "500 kbit/s", "500 and 2000 kbit/s".
std::string to_text(const wire::BitRates& rates);

}  // namespace canhil::checks
