// The stimuli of a run, before the run.
#pragma once

#include <atomic>
#include <cstdint>

#include "bench/scenario/scenario.hpp"
#include "bench/world/flight_record.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::drive {

/// Lets the nodes of a run transmit without a bus. Error, one line: a signal cannot hold a value of its node.
/// Faults are left out, because they may ask for more than a signal holds. If the missile is guided by the
/// target, its flight is not known before the run; then nothing is checked. `stop` ends the search.
Result<void> check_stimuli(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                           std::uint64_t run_index, const std::atomic<bool>& stop);

}  // namespace canhil::drive
