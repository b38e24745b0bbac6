// How much of a bus the frames of a run take.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/checks/observations.hpp"

namespace canhil::checks {

/// Shares of the time for which the bus is busy: 1 is a full bus.
struct Load {
  double mean = 0;
  double busiest = 0;  ///< of a second
};

/// The load over time: by second, of a long run the busiest of each stretch of several.
struct LoadLine {
  std::size_t stretch_s = 0;  ///< 0: nothing was carried
  std::vector<double> busiest{};
};
LoadLine load_line(std::span<const wire::BitLength> seconds, wire::BitRates rates);

/// What the bus carried by second; the second in which the run ended is not a whole one and left out, unless
/// it is the only one.
std::span<const wire::BitLength> whole_seconds(std::span<const wire::BitLength> seconds);
std::span<const wire::BitLength> whole_seconds(const Observations& seen);

/// Of the whole run at a bit rate [bit/s], in its whole_seconds().
Load bus_load(std::span<const wire::BitLength> whole_seconds, wire::BitRates rates);
Load bus_load(const Observations& seen, wire::BitRates rates);

/// "500 kbit/s", "500 and 2000 kbit/s".
std::string words(const wire::BitRates& rates);

}  // namespace canhil::checks
