// One run of a scenario, stage by stage: open the bus, configure the target, drive the schedule, collect the
// observations. A session serves a single run with a verdict, or one run of a campaign.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/checks/judge.hpp"
#include "bench/drive/adapter.hpp"
#include "bench/drive/buses.hpp"
#include "bench/drive/ending.hpp"
#include "bench/drive/flight.hpp"
#include "bench/drive/onlooker.hpp"
#include "bench/drive/real_time.hpp"
#include "bench/drive/run_files.hpp"
#include "bench/drive/target_command.hpp"
#include "bench/scenario/scenario.hpp"
#include "dbc/realtime/process.hpp"

namespace canhil::drive {

class KeptFrames;

/// simulated_wire: virtual time with simulated frame times.
enum class ClockKind : std::uint8_t { real_time, lockstep, simulated_wire };
/// The clock of a run on a bus; `lockstep`: whether lockstep was requested.
ClockKind clock_of(BusTime time, bool lockstep);

/// The options of a run, from the command line or from a campaign.
struct Options {
  BusName bus{};
  BusOf bus_of{};
  std::vector<std::string> targets;  ///< commands of the targets (target_words()); none: they already run
  BusFormat format = BusFormat::classic;
  WireFacts controller{};  ///< properties of the interface's controller, if the kernel reports them
  bool lockstep = false;   ///< instead of real time
  std::optional<std::string> log_path;        ///< candump log of every frame from the first command on
  std::optional<realtime::Request> realtime;  ///< settings of the bench; the target has its own arguments
  std::vector<std::string> target_arguments;  ///< besides --bus and --dbc; the format determines --dbc
  std::optional<int> target_cpu;              ///< none: the CPUs that the bench had before it was pinned
  std::string operator_name{};                ///< the operator's name for the report; empty: not given
  std::int64_t spin_ns = 0;     ///< time before each deadline in which the bench polls instead of sleeping
  std::uint64_t run_index = 0;  ///< in a campaign: together with the seed, selects the random numbers
  std::vector<Onlooker*> onlookers{};  ///< each also receives every frame of the flight
  std::string control{};               ///< path of the control socket; empty: the run has none
  bool awaits_control = false;         ///< the run begins when a client has connected
  bool offers_realtime = true;         ///< the command has the option --realtime, so a message may name it
  bool for_verdict = true;  ///< false: observes only the target's frames, not times, load, bus and host
};

/// The default format of a scenario's bus.
BusFormat format_of(const scenario::Scenario& scenario);

/// Options of a lockstep flight against a target that `command` starts, on a local bus that no other flight
/// uses.
Options in_lockstep_against(std::string command);

/// Options of a flight of a campaign. An empty `target`: against a Device in this process, in virtual time.
/// Otherwise against this program, which is started for the flight on a private local bus; in lockstep or,
/// with a mapping whose answers do not name their cause, in real time.
Options unattended(const std::string& target, const scenario::Scenario& scenario,
                   Rounding rounding = Rounding::as_on_the_bus);

/// The results of a session.
struct Collected {
  Ending ending;
  checks::Observations seen;
  PerRunTruth per_run_truth{};
  std::vector<faults::FaultReport> faults{};  ///< in the order of the scenario
  std::optional<Error> log_error{};           ///< why the log at Options::log_path is incomplete
};

/// A finished run.
struct Run {
  checks::Verdict verdict;
  Ending ending;
  checks::Observations seen;
  world::FlightRecord truth;
  PerRunTruth per_run_truth{};
  std::vector<faults::FaultReport> faults{};  ///< in the order of the scenario
  Options options;
  ClockKind clock = ClockKind::real_time;
  bool in_process = false;                   ///< the target was a Device in the bench's process
  std::string timing_unfit{};                ///< why no timing of the run is judged; empty: timing is judged
  std::optional<realtime::Standing> host{};  ///< settings of the bench's process; none: the run was not in
                                             ///< real time
  std::vector<RunFile> files{};      ///< the files that the run depended on, as they were at its start
  std::vector<Adapter> adapters{};   ///< adapter of the run's bus, then the adapters of the nodes' buses
  double wall_s = 0;                 ///< from the start of the estimator to the end
  std::int64_t started_s = 0;        ///< since 1970, UTC; 0: unknown
  std::optional<Error> log_error{};  ///< see Collected
  std::shared_ptr<const KeptFrames> frames{};  ///< of the flight; null: they were not kept
};

/// Runs a scenario. Error: the run was not possible (usage or configuration); if the target fails, the result
/// is a verdict, not an error.
Result<Run> run(const scenario::Scenario& scenario, const Options& options, const std::atomic<bool>& stop,
                const Progress& progress);

inline const std::atomic<bool> never_stopped = false;

/// Runs a scenario without the measurements that only a verdict needs, with the random numbers of (seed,
/// run_index). With the options of unattended() and a Device in this process, a pure function: the same
/// arguments give the same bits on any thread, unless `stop` is set, which interrupts the run; in lockstep, a
/// program that behaves like the Device gives the same samples. Error: the scenario cannot be run
/// (configuration), or the program does not start or does not answer. If the target gives up, or the drawn
/// flight cannot be flown, the result records this as the end of the run; it is not an error.
Result<Collected> observe_run(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                              std::uint64_t run_index, Options options,
                              const std::atomic<bool>& stop = never_stopped);
/// observe_run() of a Device in this process.
Result<Collected> run_in_process(const scenario::Scenario& scenario, const world::FlightRecord& truth,
                                 std::uint64_t run_index);

}  // namespace canhil::drive
