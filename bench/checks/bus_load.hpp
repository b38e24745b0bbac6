// How much of a bus the frames of a run take.
#pragma once

#include "bench/checks/finding.hpp"
#include "bench/checks/observations.hpp"

namespace canhil::checks {

/// Shares of the time for which the bus is busy: 1 is a full bus.
struct BusLoad {
  double mean = 0;
  double busiest = 0;  ///< of a second
};

/// Of the whole run at a bit rate [bit/s]; the second in which it ended is not a whole one and left out,
/// unless it is the only one.
BusLoad bus_load(const Observations& seen, wire::BitRates rates);

Finding judge(const scenario::BusLoad& rule, const Observations& seen);

}  // namespace canhil::checks
