// `hil-bench run`: its command line, and the flight of one scenario.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/commands/exit_code.hpp"
#include "bench/commands/live.hpp"
#include "bench/commands/reports.hpp"
#include "bench/drive/session.hpp"
#include "bench/scenario/scenario.hpp"
#include "dbc/command_line/command_line.hpp"
#include "dbc/ports/local_bus.hpp"
#include "dbc/realtime/command_line.hpp"

namespace canhil::commands {

/// The arguments as given on the command line.
struct RunArguments {
  std::vector<std::string> scenarios;  ///< files and folders
  std::vector<std::string> settings;   ///< each as KEY=VALUE
  std::string bus{local_prefix};       ///< a private bus
  std::vector<std::string> bus_of;     ///< each as NODE=BUS
  std::vector<std::string> targets;    ///< empty: the hil-target beside this program
  std::string dbc;                     ///< empty: the DBC of the scenario
  std::string faults;                  ///< file of additional faults; empty: none
  bool lockstep = false;
  std::string control{};
  bool awaits_control = false;
  bool no_commands = false;
  std::optional<std::uint64_t> seed;
  realtime::Options realtime;
  std::optional<int> target_cpu;
  std::optional<int> spin_us;
  std::string operator_name;
  Reports reports;
  std::string log;
  Live live;
  bool terminal = false;
  std::string selection;       ///< see select(); empty: all scenarios
  std::optional<int> at_once;  ///< how many scenarios fly at the same time
  std::string out;             ///< folder of the reports of several scenarios; empty: none
};

/// Whether the target runs elsewhere: --target none.
bool is_external(const RunArguments& arguments);

/// Adds the options. `arguments` must outlive parsing.
void add_options(command_line::Command command, RunArguments& arguments);

/// A scenario and the options of its flight.
struct PlannedRun {
  scenario::Scenario scenario;
  drive::Options options;
};
/// Reads a scenario and checks it, with the options and the files. `number`: the place of the flight among
/// several that this process starts, for which a private bus has a name of its own. Error: one line.
Result<PlannedRun> plan_run(const RunArguments& arguments, const std::string& file, int number = 0);

/// Flies a scenario and writes its reports; `then` is called if the run came to a verdict, after its reports
/// were written.
ExitCode fly(const RunArguments& arguments, PlannedRun& planned,
             const std::function<Result<void>(const drive::Run&)>& then);

}  // namespace canhil::commands
