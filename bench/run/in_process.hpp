// One run of a scenario against a Device in this process, in virtual time: what campaigns are made of.
#pragma once

#include <cstdint>

#include "bench/checks/observations.hpp"
#include "bench/run/ending.hpp"
#include "bench/run/flight.hpp"
#include "bench/scenario/scenario.hpp"
#include "bench/world/flight_record.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::run {

struct InProcessRun {
  Ending ending;
  checks::Observations seen;
  OwnTruth own_truth{};
};

/// Runs a scenario with the random numbers of (seed, run_index). A pure function: same arguments, same bits,
/// on any thread. Error: the scenario cannot be run (configuration). A target that gives up is an ending, and
/// so is what this run drew that cannot be flown.
Result<InProcessRun> run_in_process(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                                    std::uint64_t run_index, Rounding rounding = Rounding::as_on_the_bus);

}  // namespace canhil::run
