// The stimuli of a run, before the run.
#pragma once

#include <atomic>
#include <cstdint>

#include "bench/mapping/check.hpp"
#include "bench/scenario/scenario.hpp"
#include "bench/world/flight_record.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::drive {

/// Lets the nodes of a run transmit without a bus. Error, one line: a signal cannot hold a value of its node.
/// Faults are left out, because they may ask for more than a signal holds. If the missile is guided by the
/// target, its flight is not known before the run; then nothing is checked. `stop` ends the search.
Result<void> check_stimuli(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                           std::uint64_t run_index, const std::atomic<bool>& stop);

/// The values that a scenario plays to targets with a mapping, without its faults. The noise of a value is
/// estimated from two runs with other random numbers: the truth is the same in both, so the second
/// differences of their values have the variance 4 sigma^2 of white noise alone. Error, one line: the flight
/// cannot be flown.
Result<mapping::FlownValues> flown_values(const scenario::Scenario& scenario,
                                          const mapping::Mapping& mapping);

}  // namespace canhil::drive
