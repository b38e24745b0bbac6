#include "bench/drive/flight.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <variant>

#include "bench/estimators/registry.hpp"
#include "bench/nodes/registry.hpp"
#include "bench/nodes/time_keeper.hpp"
#include "bench/scenario/binding.hpp"
#include "bench/scenario/table.hpp"
#include "bench/world/motion/oscillation.hpp"
#include "bench/world/stoppable.hpp"

namespace canhil::drive {
namespace {

/// The state that a carrier transfers to the glider at release: the truth plus errors that are drawn for this
/// run. None: no plant shows such a state.
std::optional<InitialState> state_at_release(const scenario::Scenario& scenario, const PerRunTruth& own,
                                             std::int64_t t_us, const scenario::InitialSigma& sigma,
                                             world::Stream& stream) {
  using Columns = world::PlantColumns<13>;
  constexpr Columns::Names names{"attitude.roll",        "attitude.pitch",       "attitude.heading",
                                 "velocity.north",       "velocity.east",        "velocity.down",
                                 "plant.body_rate.x",    "plant.body_rate.y",    "plant.body_rate.z",
                                 "plant.air_velocity.x", "plant.air_velocity.y", "plant.air_velocity.z",
                                 "plant.height"};
  const scenario::PlantFacts* plant = scenario.plant_with(names.back());
  const auto columns = Columns::find(plants_of(own), names);
  const auto now = columns ? columns->at(t_us) : std::nullopt;
  if (plant == nullptr || !now) return std::nullopt;
  const auto three = [&](std::size_t from) { return world::Vector3(&(*now)[from]); };
  const scenario::ReleaseError& error = plant->release;
  const world::Vector3 angles = three(0) + error.attitude * stream.normal3();
  InitialState state = initial_state(
      {.t_us = t_us,
       .position = {.height = now->back()},
       .v_eb_n = three(3) + error.velocity * stream.normal3(),
       .C_bn = C_bn_from(world::Euler{.roll = angles.x(), .pitch = angles.y(), .heading = angles.z()})},
      sigma);
  const world::Vector3 rates = three(6) + error.rate * stream.normal3();
  state.air = initial_air(rates, three(9) + error.air_velocity * stream.normal3());
  return state;
}

bool starts_by_own_truth(const scenario::TargetSetup& target) {
  const estimators::Estimator* estimator = estimators::find(target.estimator);
  return estimator != nullptr && estimator->facts.start == scenario::Start::per_run_truth;
}

/// The longest time [us] of which the periods of all sensors of a plant are multiples; 0: none measures it.
std::int64_t common_period_us(const scenario::Scenario& scenario, const scenario::PlantFacts& plant) {
  std::int64_t common_us = 0;
  for (const scenario::NodeSettings& node : scenario.nodes) {
    if (!node.is_recorded() && plant.shows(node.table().samples))
      common_us = std::gcd(common_us, node.period_us());
  }
  return common_us;
}

Result<PerRunTruth> make_per_run_truth(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                                       std::uint64_t run_index) {
  PerRunTruth own;
  const auto begin = [&](const scenario::PlantFacts& facts) {
    return plant::Simulation::begin(
        *facts.setup,
        {.seed = scenario.seed, .run_index = run_index, .sensors_us = common_period_us(scenario, facts)},
        {.start = scenario.truth.start,
         .duration_us = scenario.duration_us,
         .interval_us = truth.interval_us()});
  };
  if (scenario.plant.setup != nullptr) {
    auto plant = begin(scenario.plant);
    if (!plant) return tl::unexpected(plant.error());
    own.plant = std::move(*plant);
  }
  const auto is_recorded = [&](std::string_view samples) {
    return std::ranges::any_of(scenario.nodes, [&](const scenario::NodeSettings& node) {
      return node.is_recorded() && node.table().samples == samples;
    });
  };
  for (const scenario::PlantFacts& facts : scenario.of_tables) {
    auto plant = begin(facts);
    if (!plant) return tl::unexpected(plant.error());
    if ((*plant)->flown_ahead()) (*plant)->advance(scenario.duration_us);
    if (const auto& why = (*plant)->why_failed())
      return failure(fmt::format("key 'duration_s': run {}: {}, expected a shorter run", run_index, *why));
    const bool is_sampled = std::ranges::none_of(facts.table->shows, is_recorded);
    own.of_tables.push_back(
        {.plant = std::move(*plant), .is_guided = facts.guidance.has_value(), .is_sampled = is_sampled});
  }
  return own;
}

bool defines_epochs(const scenario::NodeSettings& node) { return node.table().sensor->at_every_epoch; }

/// The shortest period of the nodes that sample at every epoch. If there is no such node, the result is its
/// cycle time in the DBC.
std::int64_t epoch_interval_us(const scenario::Scenario& scenario) {
  std::optional<std::int64_t> shortest_us;
  for (const scenario::NodeSettings& node : scenario.nodes) {
    if (defines_epochs(node))
      shortest_us = std::min(shortest_us.value_or(node.period_us()), node.period_us());
  }
  if (shortest_us) return *shortest_us;
  const nodes::Kind& kind = **std::ranges::find_if(
      nodes::all(), [](const nodes::Kind* one) { return one->table.sensor->at_every_epoch; });
  return kind.table.period_us;
}

/// A slower IMU adds whole epochs up.
Result<void> check_epochs(const scenario::Scenario& scenario) {
  const std::int64_t interval_us = epoch_interval_us(scenario);
  for (const scenario::NodeSettings& node : scenario.nodes) {
    if (defines_epochs(node) && !node.is_recorded() && node.period_us() % interval_us != 0)
      return failure(
          fmt::format("key '{}.period_ms': {:g} is not a multiple of the {:g} ms of the fastest IMU, "
                      "expected a whole multiple",
                      node.table().key, 1e-3 * static_cast<double>(node.period_us()),
                      1e-3 * static_cast<double>(interval_us)));
  }
  return {};
}

/// A plant whose step is the period of its sensors must not need a much shorter one for all of them.
Result<void> check_steps(const scenario::Scenario& scenario) {
  constexpr std::int64_t shortest_us = 100;
  for (const scenario::PlantFacts& plant : scenario.of_tables) {
    const std::int64_t step_us = common_period_us(scenario, plant);
    const auto is_its_own = [&](const scenario::NodeSettings& node) {
      return plant.shows(node.table().samples) && node.period_us() == step_us;
    };
    if (step_us == 0 || step_us >= shortest_us || std::ranges::any_of(scenario.nodes, is_its_own)) continue;
    return failure(fmt::format(
        "the periods of the sensors of [{}] are multiples of {:g} ms only, expected "
        "multiples of {:g} ms",
        plant.table->key, 1e-3 * static_cast<double>(step_us), 1e-3 * static_cast<double>(shortest_us)));
  }
  return {};
}

/// The motion between recorded samples is unknown, so an IMU must not sample much faster than the recording.
Result<void> check_density(const scenario::Scenario& scenario) {
  constexpr std::int64_t most_intervals = 10;
  const auto* recorded = std::get_if<world::Recorded>(&scenario.truth.motion);
  if (recorded == nullptr) return {};
  const std::int64_t median_us = scenario::median_step(recorded->path->sample_times_us());
  const std::int64_t interval_us = epoch_interval_us(scenario);
  if (median_us <= most_intervals * interval_us) return {};
  return failure(fmt::format(
      "key 'truth.file': a row every {:g} ms (median) is too few for an IMU of {:g} ms, expected "
      "one in {} of its intervals at least",
      1e-3 * static_cast<double>(median_us), 1e-3 * static_cast<double>(interval_us), most_intervals));
}

}  // namespace

std::vector<plant::Simulation*> PerRunTruth::plants() const {
  std::vector<plant::Simulation*> all;
  for (const OfTable& one : of_tables) all.push_back(one.plant.get());
  if (plant) all.push_back(plant.get());
  return all;
}

std::function<void(std::string)> PerRunTruth::stopper() const {
  return [stopped = stopped](std::string why) {
    if (stopped->empty()) *stopped = std::move(why);
  };
}

std::optional<std::string> PerRunTruth::why_failed() const {
  if (!stopped->empty()) return *stopped;
  return plant::why_failed(plants());
}

const world::FlightRecord& flight_of(const world::FlightRecord& of_all_runs, const PerRunTruth& own) {
  return own.plant && own.plant->flight() != nullptr ? *own.plant->flight() : of_all_runs;
}

world::PlantRecords plants_of(const PerRunTruth& own, bool sampled) {
  world::PlantRecords records;
  for (const PerRunTruth::OfTable& one : own.of_tables) {
    if (one.is_sampled || !sampled) records.push_back(&one.plant->record());
  }
  if (own.plant) records.push_back(&own.plant->record());
  return records;
}

world::PlantRecords growing_plants_of(const PerRunTruth& own) {
  world::PlantRecords records;
  for (const plant::Simulation* one : own.plants()) {
    if (!one->flown_ahead()) records.push_back(&one->record());
  }
  return records;
}

world::Truths truths_of(const world::FlightRecord& flight, const PerRunTruth& own) {
  return {.flight = flight_of(flight, own), .plants = plants_of(own)};
}

estimators::Truth truth_of(const world::FlightRecord& flight, const PerRunTruth& own,
                           std::int64_t duration_us) {
  return {.flight = flight_of(flight, own), .duration_us = duration_us, .plants = plants_of(own, true)};
}

Ending with_end_of_plant(const Ending& ending, const PerRunTruth& own, std::int64_t duration_us) {
  if (ending.kind == Ending::Kind::completed) {
    for (plant::Simulation* one : own.plants()) one->advance(duration_us);
  }
  const auto why = own.why_failed();
  return why ? Ending{Ending::Kind::plant_failed, ending.t_us, *why} : ending;
}

Result<world::FlightRecord> make_truth(const scenario::Scenario& scenario) {
  if (auto common = check_steps(scenario); !common) return tl::unexpected(common.error());
  if (auto whole = check_epochs(scenario); !whole) return tl::unexpected(whole.error());
  if (auto dense = check_density(scenario); !dense) return tl::unexpected(dense.error());
  world::FlightRecord truth(world::drawn(scenario.truth, scenario.seed), scenario.duration_us,
                            epoch_interval_us(scenario));
  if (world::Stoppable::stopped()) return failure("interrupted");
  if (auto fits = scenario.binding->fits(scenario, truth); !fits) return tl::unexpected(fits.error());
  // Checks the initial state without drawn errors. If a value does not fit into its signal, the scenario is
  // rejected here, before its first run. make_flight() checks the initial state with the errors that are
  // drawn for its run.
  for (const scenario::TargetSetup& target : scenario.targets) {
    world::Stream none(0, 0, "none");
    const auto start = initial_solution(truth.epochs().front(), world::InitialErrorModel{}, none);
    if (auto fits = check_fits(initial_state(start, target.initial_sigma)); !fits)
      return tl::unexpected(fits.error());
  }
  return truth;
}

Result<Flight> make_flight(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                           std::uint64_t run_index) {
  auto per_run_truth = make_per_run_truth(scenario, truth, run_index);
  if (!per_run_truth) return tl::unexpected(per_run_truth.error());
  Flight flight{.per_run_truth = std::move(*per_run_truth), .initial = {}};
  flight.initial = initial_states(scenario, truth, flight.per_run_truth, run_index, 0);
  for (const InitialState& state : flight.initial) {
    if (auto fits = check_fits(state); !fits) return tl::unexpected(fits.error());
  }
  return flight;
}

std::vector<InitialState> initial_states(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                                         const PerRunTruth& per_run_truth, std::uint64_t run_index,
                                         std::int64_t t_us) {
  std::vector<InitialState> states;
  const world::FlightRecord& flown = flight_of(truth, per_run_truth);
  for (const scenario::TargetSetup& target : scenario.targets) {
    world::Stream stream(scenario.seed, run_index, "initial_error");
    const world::InitialErrorModel error = target.initial_error.value_or(scenario.initial_error);
    std::optional<InitialState> released;
    if (starts_by_own_truth(target))
      released = state_at_release(scenario, per_run_truth, t_us, target.initial_sigma, stream);
    states.push_back(
        released
            ? std::move(*released)
            : initial_state(initial_solution(flown.at(std::min(t_us, flown.known_until_us())), error, stream),
                            target.initial_sigma));
  }
  return states;
}

sensors::Run run_of(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                    PerRunTruth& per_run_truth, std::uint64_t run_index, sensors::SensorFaults* faults) {
  sensors::Run run{.scenario = scenario,
                   .index = run_index,
                   .flight = flight_of(truth, per_run_truth),
                   .plants = plants_of(per_run_truth),
                   .faults = faults,
                   .fail = per_run_truth.stopper(),
                   .overrides = per_run_truth.overrides.get()};
  for (const PerRunTruth::OfTable& one : per_run_truth.of_tables) {
    if (one.is_guided)
      run.guide = [plant = one.plant.get()](std::int64_t from_us, std::span<const double> inputs) {
        plant->guide(from_us, inputs);
      };
  }
  return run;
}

Schedule make_schedule(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                       PerRunTruth& per_run_truth, std::uint64_t run_index, bool lockstep, Rounding rounding,
                       std::unique_ptr<faults::Faults> faults) {
  if (faults == nullptr)
    faults = std::make_unique<faults::Faults>(scenario, run_index, scenario.binding->messages);
  auto nodes = nodes::make(run_of(scenario, truth, per_run_truth, run_index, faults.get()));
  return {std::move(nodes), std::make_unique<nodes::TimeKeeper>(truth.end_us(), lockstep), rounding,
          std::move(faults), per_run_truth.plants()};
}

}  // namespace canhil::drive
