#include "bench/commands/run_options.hpp"

#include <fmt/format.h>
#include <net/if.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/commands/program.hpp"
#include "bench/doctor/interface.hpp"
#include "bench/drive/adapter.hpp"
#include "bench/drive/contract.hpp"
#include "bench/drive/inputs.hpp"
#include "bench/drive/session.hpp"
#include "bench/nodes/registry.hpp"
#include "bench/observe/recorder.hpp"
#include "bench/processes/command.hpp"
#include "bench/scenario/binding.hpp"
#include "bench/scenario/commands.hpp"
#include "bench/scenario/nearest.hpp"
#include "dbc/files/command_files.hpp"

namespace canhil::commands {
bool is_external(const RunArguments& arguments) {
  return arguments.targets == std::vector<std::string>{"none"};
}

namespace {

constexpr std::size_t heap_bytes = 64 << 20;  // enough for a recording of several minutes

// The name of a node without underscores, in lower case: gps, GPS and Gps name the same node; master_ins and
// MasterIns, too, name the same node.
std::string plain(std::string name) {
  std::erase(name, '_');
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

// Whether a node of the bench is on the bus of a scenario.
bool is_on_bus(const scenario::Scenario& scenario, std::string_view sender) {
  const scenario::Binding& binding = *scenario.binding;
  return std::ranges::any_of(binding.messages, [&](const MessageInfo& one) {
    return !is_targets(one) && binding.sender_of(one) == sender &&
           (binding.is_played(one, scenario.nodes) || binding.is_of_events(one));
  });
}

// Parses all NODE=BUS, and replaces NODE by the name of the node in the DBC. The frames of the bench itself
// and of the target always use --bus.
Result<drive::BusOf> buses_of(const RunArguments& arguments, const scenario::Scenario& scenario) {
  const std::vector<std::string>& senders = scenario.binding->senders;
  drive::BusOf all;
  for (const std::string& text : arguments.bus_of) {
    const std::size_t equals = text.find('=');
    const auto node = std::ranges::find_if(
        senders, [&](const std::string& name) { return plain(name) == plain(text.substr(0, equals)); });
    const std::string bus = equals == std::string::npos ? "" : text.substr(equals + 1);
    if (node == senders.end() || bus.empty() || bus == local_prefix || drive::BusName(bus).in_process)
      return failure(fmt::format(
          "--bus-of '{}': expected NODE=BUS with NODE one of {} and BUS an interface or local:NAME", text,
          fmt::join(senders, ", ")));
    if (std::ranges::find(all, *node, &drive::BusOf::value_type::first) != all.end())
      return failure(
          fmt::format("--bus-of '{}': {} has a bus already, expected each node once", text, *node));
    if (bus == arguments.bus)
      return failure(
          fmt::format("--bus-of '{}': is the bus of all others, expected another than --bus", text));
    if (!is_on_bus(scenario, *node))
      return failure(
          fmt::format("--bus-of '{}': {} has no such node, expected one that it has", text, scenario.file));
    all.emplace_back(*node, bus);
  }
  return all;
}

// The bit rates of an interface's controller, as the kernel reports them; empty if the kernel reports none.
WireFacts controller_of(const std::string& bus) {
  const auto interface = doctor::find_interface(bus);
  if (!interface || !interface->controller) return {};
  return {.rates = {.nominal = interface->controller->nominal.bitrate,
                    .data = interface->controller->data.bitrate}};
}

// The name of a private bus of this process.
std::string private_bus(int number) {
  return number == 0 ? fmt::format("canhil-{}", getpid()) : fmt::format("canhil-{}-{}", getpid(), number);
}

drive::Options options_of(const RunArguments& arguments, drive::BusName bus, drive::BusOf bus_of,
                          BusFormat format, int number) {
  drive::Options options;
  options.format = format;
  const bool external = is_external(arguments);
  options.bus = std::move(bus);
  // The name of a private bus contains the process id, so two benches on one machine do not share a bus. With
  // --target none, the name is fixed, so that an external target can use this name.
  options.bus.text = named_local(options.bus.text, external ? "canhil" : private_bus(number));
  if (!external)
    options.targets = arguments.targets.empty()
                          ? std::vector{processes::quoted_word(own_folder() + "/hil-target")}
                          : arguments.targets;
  if (arguments.bus_of.empty()) options.controller = controller_of(options.bus.text);
  options.lockstep = arguments.lockstep;
  options.control = arguments.control;
  options.awaits_control = arguments.awaits_control;
  if (!arguments.log.empty()) options.log_path = arguments.log;
  options.realtime = arguments.realtime.request();
  if (options.realtime) {
    options.realtime->heap_bytes = heap_bytes;
    // Every target inherits the scheduling policy and the priority. hil-target, in addition, gets these
    // options, so that it also locks its memory.
    if (arguments.targets.empty())
      options.target_arguments = {"--realtime", "--priority", std::to_string(options.realtime->priority)};
  }
  options.bus_of = std::move(bus_of);
  for (const auto& [node, own] : options.bus_of) {
    if (!external) options.target_arguments.insert(options.target_arguments.end(), {"--bus", own});
  }
  options.target_cpu = arguments.target_cpu;
  options.operator_name = arguments.operator_name;
  options.spin_ns = std::int64_t{arguments.spin_us.value_or(0)} * 1000;
  return options;
}

Result<void> check_files(const RunArguments& arguments, const scenario::Scenario& scenario,
                         const drive::Options& options) {
  CommandFiles files;
  files.reads(drive::inputs_of(scenario));
  if (arguments.dbc != name_of(BusFormat::classic) && arguments.dbc != name_of(BusFormat::fd))
    files.reads("--dbc", arguments.dbc);
  for (const std::string& command : options.targets) files.reads(drive::inputs_of_target(command));
  declare(arguments.reports, files);
  files.writes_file("--log", arguments.log);
  if (!arguments.log.empty()) files.may_write("incomplete log", observe::incomplete_log(arguments.log));
  return files.check();
}

Result<void> check_bus(const RunArguments& arguments, const drive::BusName& bus) {
  const bool here = bus.in_process;
  if (here && !arguments.targets.empty())
    return failure(
        "--target: with --bus in-process the device is in hil-bench itself, expected only one of the two");
  if (here && (arguments.realtime.wanted || arguments.spin_us))
    return failure(
        "--bus in-process: virtual time has no deadlines, expected neither --realtime nor --spin-us");
  if (bus.rounding == Rounding::none && !arguments.log.empty())
    return failure(
        fmt::format("--log: a log has no room for the frames of '{}', expected in-process", arguments.bus));
  // Frames on two buses have no common order: the answer to a step could arrive before a sample on the other
  // bus.
  if (!arguments.bus_of.empty() && (arguments.lockstep || here))
    return failure("--bus-of: one step over two buses has no order, expected real time");
  if (arguments.lockstep && bus.wire && bus.wire->order == QueueOrder::priority)
    return failure(
        fmt::format("--lockstep: with the queues of --bus '{}' Sync overtakes the samples of its step, "
                    "expected queue=fifo",
                    arguments.bus));
  if (arguments.target_cpu && (is_external(arguments) || here))
    return failure("--target-cpu: no target is started here, expected one with --target and a bus");
  if (arguments.target_cpu) {
    if (auto known = realtime::check_cpu("--target-cpu", *arguments.target_cpu); !known) return known;
  }
  static const std::vector<std::string> known{std::string(drive::in_process_bus), std::string(local_prefix)};
  const bool names_one = is_local(arguments.bus) || here;
  const std::string meant = scenario::nearest(arguments.bus, known);
  if (!names_one && !meant.empty() && if_nametoindex(arguments.bus.c_str()) == 0)
    return failure(
        fmt::format("--bus '{}': there is no such interface, expected '{}'", arguments.bus, meant));
  return {};
}

// The format of the bus: from the command line, from the scenario, or from both if they agree.
Result<BusFormat> format_of(const RunArguments& arguments, const scenario::Scenario& scenario) {
  if (arguments.dbc.empty()) return drive::format_of(scenario);
  if (!scenario.binding->containers)
    return failure(fmt::format("--dbc {}: {} has a mapping, whose DBC counts, expected one of the two",
                               arguments.dbc, scenario.file));
  auto named = named_contract(arguments.dbc);
  if (named && scenario.fd && *scenario.fd != (*named == BusFormat::fd)) {
    return failure(fmt::format("--dbc '{}': {} has dbc = \"{}\", expected one of the two or both alike",
                               arguments.dbc, scenario.file,
                               name_of(*scenario.fd ? BusFormat::fd : BusFormat::classic)));
  }
  return named;
}

// Checks that there is a target of the scenario for each program.
Result<void> check_targets(const RunArguments& arguments, const scenario::Scenario& scenario) {
  const std::size_t most = scenario.binding->handshake ? 1 : scenario.targets.size();
  if (arguments.targets.size() > most)
    return failure(fmt::format("--target: is given {} times, expected at most {}, as {} has {} on its bus",
                               arguments.targets.size(), most, scenario.file,
                               most == 1 ? "one target" : fmt::format("{} targets", most)));
  if (arguments.targets.empty() && !scenario.binding->handshake)
    return failure(
        fmt::format("--target: is missing, and the target of {} is not hil-target, expected its program, or "
                    "none if it runs elsewhere",
                    scenario.file));
  if (arguments.targets.size() > 1 && std::ranges::find(arguments.targets, "none") != arguments.targets.end())
    return failure("--target none: is given beside a program, expected only one of the two");
  return {};
}

// Checks that the name fits into one line of the text report and into XML.
Result<void> check_operator(const std::string& name) {
  const bool plain =
      std::ranges::none_of(name, [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; });
  return plain ? Result<void>()
               : failure("--operator: holds a control character, expected a name on one line");
}

}  // namespace

Result<PlannedRun> plan_run(const RunArguments& given, const std::string& file, int number) {
  auto interface = drive::bus_of_adapter(given.bus);
  if (!interface) return tl::unexpected(interface.error());
  RunArguments arguments = given;
  arguments.bus = *std::move(interface);
  if (auto fine = check_operator(arguments.operator_name); !fine) return tl::unexpected(fine.error());
  const drive::BusName bus(arguments.bus);
  if (auto fine = check_bus(arguments, bus); !fine) return tl::unexpected(fine.error());
  if (arguments.no_commands) scenario::forbid_commands();
  const auto settings = scenario::parse_settings(arguments.settings);
  if (!settings) return tl::unexpected(settings.error());
  auto scenario = drive::read_scenario(file, *settings);
  if (!scenario) return tl::unexpected(scenario.error());
  if (!arguments.faults.empty()) {
    if (auto added = drive::add_faults(*scenario, arguments.faults); !added)
      return tl::unexpected(added.error());
  }
  if (auto fine = check_targets(arguments, *scenario); !fine) return tl::unexpected(fine.error());
  auto bus_of = buses_of(arguments, *scenario);
  if (!bus_of) return tl::unexpected(bus_of.error());
  const auto format = format_of(arguments, *scenario);
  if (!format) return tl::unexpected(format.error());
  if (arguments.seed) scenario->seed = *arguments.seed;
  drive::Options options = options_of(arguments, bus, std::move(*bus_of), *format, number);
  if (auto fine = check_files(arguments, *scenario, options); !fine) return tl::unexpected(fine.error());
  return PlannedRun{.scenario = std::move(*scenario), .options = std::move(options)};
}

void add_options(command_line::Command command, RunArguments& arguments) {
  command
      .add_option("SCENARIO", arguments.scenarios,
                  "scenario file (TOML), or a folder of scenarios; may be several")
      .required();
  command.add_option(
      "--bus", arguments.bus,
      "can0, vcan0: SocketCAN; serial:NUMBER: the USB adapter with this serial number; local:NAME: embedded "
      "bus; local: a private one (default); in-process: virtual "
      "time. local: and in-process take a simulated wire: '?bitrate=500000', then &data-bitrate=2000000, "
      "&queue=fifo|priority, &bit-error-rate=1e-6, &seed=3. 'in-process?unrounded': frames that round "
      "nothing");
  command
      .add_option("--bus-of", arguments.bus_of,
                  "NODE=BUS: this node sends on a bus of its own, such as gps=can1; may be given again. The "
                  "target is to listen there too")
      .one_word_each();
  command
      .add_option("--target", arguments.targets,
                  "program to start as target, with its arguments, as one word: 'python3 mine.py --gain 3' "
                  "(default: hil-target beside hil-bench); none: it runs elsewhere. With several mapped "
                  "targets: may be given again")
      .one_word_each();
  command.add_option(
      "--dbc", arguments.dbc,
      "contract of the bus: canhil, canhil-fd (CAN FD), or the file of one of them (default: the "
      "scenario's, else canhil)");
  command
      .add_option("--set", arguments.settings,
                  "KEY=VALUE: a value in place of the scenario's, such as target.algorithm=ekf; may be given "
                  "again")
      .one_word_each();
  command.add_option("--faults", arguments.faults,
                     "file of [[fault]] tables, in addition to the scenario's (docs/faults.md)");
  command.add_flag("--no-commands", arguments.no_commands,
                   "refuse scenarios that execute something: commands, programs, FMUs");
  const auto lockstep =
      command.add_flag("--lockstep", arguments.lockstep, "virtual time: as fast as the target answers");
  realtime::add_options(command, arguments.realtime).excludes(lockstep);
  command.add_number("--target-cpu", arguments.target_cpu,
                     "the only CPU of the target that this command starts", 0, 1023);
  command
      .add_number("--spin-us", arguments.spin_us,
                  "poll for so long before each deadline instead of sleeping up to it", 0, 10'000)
      .excludes(lockstep);
  const auto control =
      command.add_option("--control", arguments.control,
                         "path of a local socket through which a program of yours takes part in the run "
                         "(docs/programs.md)");
  command
      .add_flag("--await-control", arguments.awaits_control,
                "begin the run when a program has connected to the socket of --control")
      .needs(control);
  command.add_number("--seed", arguments.seed, "another seed than the scenario's");
  add_reports(command, arguments.reports);
  command.add_option("--operator", arguments.operator_name,
                     "who runs it, for the reports: 'Ada Lovelace' (default: not said)");
  command.add_option("--log", arguments.log,
                     "record every frame: *.log (candump), *.pcap (Wireshark), *.asc (Vector)");
  command.add_option(
      "-k,--select", arguments.selection,
      "only scenarios whose file or title has these words: 'wind and not quick' (with and, or, "
      "not, parentheses)");
  command.add_number("-j,--jobs", arguments.at_once, "how many of several scenarios fly at once (default: 1)",
                     1, 1024);
  command.add_option("--out", arguments.out,
                     "folder of the pages, JSON reports and logs of several scenarios, with index.html");
  command.add_flag("--tui", arguments.terminal, "show it on one screen of this terminal while it goes on")
      .excludes(add_live(command, arguments.live));
}

}  // namespace canhil::commands
