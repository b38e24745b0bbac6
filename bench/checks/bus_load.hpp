// The bus load of a run.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/checks/observations.hpp"

namespace canhil::checks {

/// How busy the bus is, as a fraction of time: 0 is an idle bus, 1 is a full bus.
struct Load {
  double mean = 0;
  double busiest = 0;               ///< load in the busiest second
  std::int64_t busiest_second = 0;  ///< index of the first busiest second
};

/// The load over time. A short run has one value for each second. A long run has one value for each stretch
/// of several seconds: the load in the busiest second of the stretch.
struct LoadLine {
  std::size_t stretch_s = 0;  ///< length of a stretch; 0: there were no frames
  std::vector<double> busiest{};
};
LoadLine load_line(std::span<const wire::BitLength> seconds, wire::BitRates rates);

/// The bits on the bus in each second of a run. The last second is incomplete, so it is omitted, except in a
/// run that has only this second.
std::span<const wire::BitLength> whole_seconds(std::span<const wire::BitLength> seconds);
std::span<const wire::BitLength> whole_seconds(const Observations& seen);

/// The load over the whole_seconds() of a run, at a bit rate [bit/s].
Load bus_load(std::span<const wire::BitLength> whole_seconds, wire::BitRates rates);
Load bus_load(const Observations& seen, wire::BitRates rates);

/// "500 kbit/s", "500 and 2000 kbit/s".
std::string to_text(const wire::BitRates& rates);

}  // namespace canhil::checks
