// One run of a scenario, stage by stage: its bus is opened, its target configured, its schedule driven, what
// was seen collected. For a verdict, or for a campaign.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/checks/judge.hpp"
#include "bench/drive/buses.hpp"
#include "bench/drive/ending.hpp"
#include "bench/drive/flight.hpp"
#include "bench/drive/onlooker.hpp"
#include "bench/drive/real_time.hpp"
#include "bench/drive/target_command.hpp"
#include "bench/scenario/scenario.hpp"
#include "dbc/realtime/process.hpp"

namespace canhil::drive {

/// simulated_wire: virtual time too, in which the frames take the time of a wire.
enum class ClockKind : std::uint8_t { real_time, lockstep, simulated_wire };
/// The clock of a run on a bus; `lockstep`: asked for.
ClockKind clock_of(BusTime time, bool lockstep);

/// What the command line decides, or a campaign.
struct Options {
  BusName bus{};
  BusOf bus_of{};
  std::optional<std::string> target;  ///< command to start (target_words()); none: it already runs on the bus
  BusFormat format = BusFormat::classic;
  WireFacts controller{};                     ///< of an interface, where the kernel tells
  bool lockstep = false;                      ///< rather than real time
  std::optional<std::string> log_path;        ///< candump log of every frame from the first command on
  std::optional<realtime::Request> realtime;  ///< for the bench itself; the target's is among its arguments
  std::vector<std::string> target_arguments;  ///< besides --bus, and --dbc, which follows from the format
  std::optional<int> target_cpu;              ///< none: those of the bench before it was pinned
  std::int64_t spin_ns = 0;                   ///< before each deadline the bench polls instead of sleeping
  std::uint64_t run_index = 0;  ///< of a campaign: selects the random numbers together with the seed
  Onlooker* onlooker = nullptr;  ///< sees every frame of the flight too; none: null
  bool for_verdict = true;  ///< false: only what the target says is observed, not times, load, bus and host
};

/// That of a scenario's bus, if nothing else is asked for.
BusFormat format_of(const scenario::Scenario& scenario);

/// Of a flight in lockstep against this target, started for it on a local bus of its own.
Options in_lockstep_against(std::string command);

/// What a session has seen.
struct Collected {
  Ending ending;
  checks::Observations seen;
  OwnTruth own_truth{};
  std::vector<faults::Told> faults{};  ///< in the order of the scenario
  std::optional<Error> log_error{};    ///< why Options::log_path does not hold every frame
};

/// A finished run.
struct Run {
  checks::Verdict verdict;
  Ending ending;
  checks::Observations seen;
  world::FlightRecord truth;
  OwnTruth own_truth{};
  std::vector<faults::Told> faults{};  ///< in the order of the scenario
  Options options;
  ClockKind clock = ClockKind::real_time;
  bool in_process = false;                   ///< the target was the bench's own device
  std::string timing_unfit{};                ///< why no timing of the run is judged; empty: it is
  std::optional<realtime::Standing> host{};  ///< of the bench, in real time
  /// The files of Options::target when it was started, its program first; empty: it was not.
  std::vector<std::pair<std::string, ProgramFile>> target_files{};
  double wall_s = 0;                 ///< from the start of the estimator to the end
  std::int64_t started_s = 0;        ///< since 1970, UTC; 0: unknown
  std::optional<Error> log_error{};  ///< see Collected
};

/// Runs a scenario. Error: the run could not take place (usage or configuration); a target that fails is a
/// verdict.
Result<Run> run(const scenario::Scenario& scenario, const Options& options, const std::atomic<bool>& stop,
                const Progress& progress);

/// Runs a scenario for a campaign: against a Device in this process, in virtual time, with the random numbers
/// of (seed, run_index). A pure function: same arguments, same bits, on any thread. Error: the scenario
/// cannot be run (configuration). A target that gives up is an ending, and so is what this run drew that
/// cannot be flown.
Result<Collected> run_in_process(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                                 std::uint64_t run_index, Rounding rounding = Rounding::as_on_the_bus);

/// The same against a program, started for this run on a private local bus, in lockstep: a target that
/// behaves as the Device gives the same samples. Error: also a program that does not start or answer.
Result<Collected> run_against(const std::string& target, const scenario::Scenario& scenario,
                              const world::FlightRecord& truth, std::uint64_t run_index);

}  // namespace canhil::drive
