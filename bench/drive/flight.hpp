// A scenario made ready to run: its truth, its nodes, and what the target is told at the start.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bench/checks/estimator.hpp"
#include "bench/drive/initial_state.hpp"
#include "bench/drive/schedule.hpp"
#include "bench/scenario/scenario.hpp"
#include "bench/world/engagement/engagement.hpp"
#include "bench/world/flight_record.hpp"
#include "bench/world/glide/glide.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::drive {

/// The truth of a scenario on the grid of its IMU. The same for every run: compute it once. Error: one line,
/// if no run of the scenario can be flown.
Result<world::FlightRecord> make_truth(const scenario::Scenario& scenario);

/// What a run flies by itself, because it draws it or its answers steer it.
struct PerRunTruth {
  std::optional<world::EngagementRecord> engagement{};  ///< none: not in the scenario; filled as it goes on
  std::optional<world::GlideRecord> glide{};            ///< none: not in the scenario
  bool glide_is_sampled = true;  ///< false: its nodes send what was recorded of another
};

/// All of it, as answers are held against it. `duration_us`: of the run.
estimators::Truth truth_of(const world::FlightRecord& flight, const PerRunTruth& own,
                           std::int64_t duration_us);

/// What one run draws before it begins.
struct Flight {
  PerRunTruth per_run_truth;
  /// What each estimator of the target is told: the truth with the errors that this run draws, the same draw
  /// for each.
  std::vector<InitialState> initial;
};

/// The flight of run `run_index`. Error: one line, if it ends before the run, or the bus cannot carry what
/// the target is told.
Result<Flight> make_flight(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                           std::uint64_t run_index);

/// What each estimator of the target is told at a time of the run: the errors are those of its start.
std::vector<InitialState> initial_states(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                                         const PerRunTruth& per_run_truth, std::uint64_t run_index,
                                         std::int64_t t_us);

/// The nodes of run `run_index`, in the order of precedence. All but the index must outlive the schedule.
/// `faults`: of the run; null: those of the scenario that need no more than the frames.
Schedule make_schedule(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                       PerRunTruth& per_run_truth, std::uint64_t run_index, bool lockstep,
                       Rounding rounding = Rounding::as_on_the_bus,
                       std::unique_ptr<faults::Faults> faults = nullptr);

}  // namespace canhil::drive
