// Prepares a scenario for running: its truth, its nodes, and the initial state for the target.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "bench/checks/estimator.hpp"
#include "bench/drive/ending.hpp"
#include "bench/drive/initial_state.hpp"
#include "bench/drive/schedule.hpp"
#include "bench/plant/simulation.hpp"
#include "bench/scenario/scenario.hpp"
#include "bench/sensors/overrides.hpp"
#include "bench/world/flight_record.hpp"
#include "bench/world/truth_values.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::drive {

/// The truth of a scenario at the sample times of its IMU. The truth is the same for every run, so compute it
/// only once. Error, one line: no run of the scenario can be flown.
Result<world::FlightRecord> make_truth(const scenario::Scenario& scenario);

/// Truth that differs from run to run, because errors are drawn or the target steers.
struct PerRunTruth {
  std::unique_ptr<plant::Simulation> plant{};  ///< of [plant]; null: the scenario has none
  /// A plant with tables of its own.
  struct OfTable {
    std::unique_ptr<plant::Simulation> plant;
    bool is_guided = false;  ///< the target's answers guide it
    bool is_sampled = true;  ///< false: its nodes send a recording of what another plant did
  };
  std::vector<OfTable> of_tables{};  ///< as Scenario::of_tables
  /// Why the run cannot go on: a sensor cannot measure, or a partner ended it. Empty: it can.
  std::shared_ptr<std::string> stopped = std::make_shared<std::string>();
  std::shared_ptr<sensors::Overrides> overrides{};  ///< by partners; null: the run has none

  [[nodiscard]] std::vector<plant::Simulation*> plants() const;
  /// Ends the run; of several reasons, the first counts.
  [[nodiscard]] std::function<void(std::string why)> stopper() const;
  /// Why the run cannot go on: a plant, a sensor, a partner. None: it can.
  [[nodiscard]] std::optional<std::string> why_failed() const;
};

/// The flight of a run: that of the plant if it moves the carrier, otherwise the flight of all runs.
const world::FlightRecord& flight_of(const world::FlightRecord& of_all_runs, const PerRunTruth& own);
/// The records of the plants of a run. `sampled`: but for those whose nodes are recorded.
world::PlantRecords plants_of(const PerRunTruth& own, bool sampled = false);
/// The records that grow during the run, in its thread.
world::PlantRecords growing_plants_of(const PerRunTruth& own);
/// The true values of a run.
world::Truths truths_of(const world::FlightRecord& flight, const PerRunTruth& own);

/// The complete truth, for comparison with answers. `duration_us`: duration of the run.
estimators::Truth truth_of(const world::FlightRecord& flight, const PerRunTruth& own,
                           std::int64_t duration_us);

/// Advances the plants to the end of a completed run: the truth of the last samples needs it. Returns how the
/// run ended, which a plant that failed decides.
Ending with_end_of_plant(const Ending& ending, const PerRunTruth& own, std::int64_t duration_us);

/// The parts of a run that are drawn at random before the run begins.
struct Flight {
  PerRunTruth per_run_truth;
  /// The initial state for each estimator of the target: the truth plus the errors that are drawn for this
  /// run. All estimators get the same draw.
  std::vector<InitialState> initial;
};

/// The flight of run `run_index`. Error, one line: a plant ends before the end of the run or cannot be
/// made, or the bus cannot carry the initial state.
Result<Flight> make_flight(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                           std::uint64_t run_index);

/// The initial state for each estimator at the time `t_us` of the run: the truth at this time plus the
/// initial errors that are drawn for the run.
std::vector<InitialState> initial_states(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                                         const PerRunTruth& per_run_truth, std::uint64_t run_index,
                                         std::int64_t t_us);

/// What the sensors of a run use.
sensors::Run run_of(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                    PerRunTruth& per_run_truth, std::uint64_t run_index,
                    sensors::SensorFaults* faults = nullptr);

/// The schedule of run `run_index`, with its nodes in order of precedence. The referenced objects must
/// outlive the schedule. `faults`: faults of the run; null: the schedule contains only those faults of the
/// scenario that act on frames.
Schedule make_schedule(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                       PerRunTruth& per_run_truth, std::uint64_t run_index, bool lockstep,
                       Rounding rounding = Rounding::as_on_the_bus,
                       std::unique_ptr<faults::Faults> faults = nullptr);

}  // namespace canhil::drive
