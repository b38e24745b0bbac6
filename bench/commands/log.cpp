// hil-bench log, replay, check: commands for recorded frames.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/commands/exit_code.hpp"
#include "bench/commands/interrupt.hpp"
#include "bench/commands/progress_line.hpp"
#include "bench/commands/reports.hpp"
#include "bench/commands/subcommands.hpp"
#include "bench/drive/contract.hpp"
#include "bench/drive/inputs.hpp"
#include "bench/drive/kept_frames.hpp"
#include "bench/drive/recording.hpp"
#include "bench/recordings/convert.hpp"
#include "bench/recordings/replay.hpp"
#include "bench/report/file.hpp"
#include "bench/report/program_checks.hpp"
#include "dbc/files/command_files.hpp"
#include "dbc/ports/fd_groups.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil::commands {
namespace {

constexpr double slowest = 1e-3, fastest = 1e3;

// The arguments as given on the command line.
struct ConvertArguments {
  std::string from, to, format;
};
struct ReplayArguments {
  std::string log, bus, direction = "both";
  std::vector<std::string> channels;
  double speed = 1;
  std::optional<std::uint64_t> loops;
  std::vector<std::string> only;
  bool fd = false;
};
struct CheckArguments {
  std::string log, scenario;
  std::optional<std::uint64_t> seed;
  std::string faults;
  std::vector<std::string> settings;  // each as KEY=VALUE
  Reports reports;
};

ExitCode convert(const ConvertArguments& arguments) {
  CommandFiles files;
  files.reads("FROM", arguments.from);
  files.writes_file("TO", arguments.to);
  if (auto fine = files.check(); !fine) return complain(fine.error());
  const auto named = log_format(arguments.format);
  const auto format = named ? Result<LogFormat>(*named) : log_format_of_file(arguments.to);
  if (!format) return complain(format.error());
  const auto converted = recordings::convert(arguments.from, arguments.to, *format);
  if (!converted) return complain(converted.error());
  if (*converted == 0) say(fmt::format("log '{}': has no frame", arguments.from));
  fmt::print("{}: {} frames\n", one_line(arguments.to), *converted);
  return ExitCode::pass;
}

Result<std::vector<std::uint32_t>> ids_of(const std::vector<std::string>& words) {
  std::vector<std::uint32_t> ids;
  for (const std::string& word : words) {
    std::size_t read = 0;
    unsigned long id = 0;
    if (!word.empty() && std::isxdigit(static_cast<unsigned char>(word.front())) != 0 && word.size() <= 10)
      id = std::stoul(word, &read, 16);
    if (read == 0 || read != word.size() || id > max_extended_id)
      return failure(fmt::format("--only '{}': expected an id as hexadecimal digits, up to 1FFFFFFF", word));
    ids.push_back(static_cast<std::uint32_t>(id));
  }
  return ids;
}

// A bus by its name, and the interface of the log whose frames it carries; an empty interface: all.
struct Route {
  std::string interface, bus;
};

// The routes of --bus and --channel. `interfaces` are those of the log. The error states which there are.
Result<std::vector<Route>> routes_of(const ReplayArguments& arguments,
                                     const std::vector<std::string>& interfaces) {
  const auto fail = [&](const std::string& what) {
    return failure(fmt::format("{}; the log has frames of: {}", what, fmt::join(interfaces, ", ")));
  };
  if (arguments.channels.empty()) {
    if (arguments.bus.empty()) return fail("--bus or --channel INTERFACE=BUS is missing");
    if (interfaces.size() > 1)
      return fail(
          fmt::format("--bus '{}': the frames are of {} interfaces, expected --channel with one of them, or "
                      "--channel INTERFACE=BUS for some of them",
                      arguments.bus, interfaces.size()));
    return std::vector{Route{.interface = {}, .bus = arguments.bus}};
  }
  std::vector<Route> routes;
  for (const std::string& channel : arguments.channels) {
    const std::size_t equals = channel.find('=');
    Route route{.interface = channel.substr(0, equals),
                .bus = equals == std::string::npos ? arguments.bus : channel.substr(equals + 1)};
    if (std::ranges::find(interfaces, route.interface) == interfaces.end())
      return fail(fmt::format("--channel '{}': expected an interface of the log", channel));
    if (route.bus.empty())
      return fail(fmt::format("--channel '{}': expected INTERFACE=BUS, or --bus", channel));
    for (const Route& other : routes) {
      if (other.interface == route.interface || other.bus == route.bus)
        return fail(fmt::format(
            "--channel '{}': is the second for this interface or bus, expected one for each", channel));
    }
    routes.push_back(std::move(route));
  }
  if (!arguments.bus.empty() && routes.size() > 1 &&
      std::ranges::none_of(routes, [&](const Route& route) { return route.bus == arguments.bus; }))
    return fail(fmt::format("--bus '{}': no --channel uses it, expected one without '='", arguments.bus));
  return routes;
}

ExitCode replay(const ReplayArguments& arguments) {
  const auto ids = ids_of(arguments.only);
  if (!ids) return complain(ids.error());
  const recordings::ReplayOptions options{.speed = arguments.speed,
                                          .loops = arguments.loops.value_or(1),
                                          .only = *ids,
                                          .transmitted = arguments.direction == "both"
                                                             ? std::nullopt
                                                             : std::optional(arguments.direction == "sent")};
  const auto log = LogFile::open(arguments.log);
  if (!log) return complain(log.error());
  const auto interfaces = recordings::interfaces_of(*log, options);
  if (!interfaces) return complain(interfaces.error());
  const auto routes = routes_of(arguments, *interfaces);
  if (!routes) return complain(routes.error());
  std::vector<std::unique_ptr<Port>> ports;
  std::vector<recordings::ReplayBus> buses;
  std::vector<std::string> names;
  for (const Route& route : *routes) {
    auto port = join_or_host(route.bus, {.fd = arguments.fd, .node_name = "hil-bench replay"},
                             arguments.fd ? BusFormat::fd_frames : BusFormat::classic);
    if (!port) return complain(port.error());
    buses.push_back({.port = *ports.emplace_back(std::move(*port)), .interface = route.interface});
    names.push_back(one_line(route.bus));
  }
  catch_interrupts();
  const auto replayed = [&] {
    const ProgressLine line;
    return recordings::replay(buses, *log, options, interrupted, [&](std::uint64_t frames) {
      if (frames % 256 == 0) line.show([&] { return fmt::format("{} frames", frames); });
    });
  }();
  if (!replayed) return complain(replayed.error());
  const checks::Histogram& late = replayed->lateness;
  fmt::print("{} frames on {}; late by {:.0f} us (median), {:.0f} us (99 %), {:.0f} us (most)\n",
             replayed->frames, fmt::join(names, ", "), late.quantile_ns(0.5) / 1e3,
             late.quantile_ns(0.99) / 1e3, static_cast<double>(late.max_ns()) / 1e3);
  return ExitCode::pass;
}

ExitCode check(const CheckArguments& arguments) {
  const auto settings = scenario::parse_settings(arguments.settings);
  if (!settings) return complain(settings.error());
  auto scenario = drive::read_scenario(arguments.scenario, *settings);
  if (!scenario) return complain(scenario.error());
  if (!arguments.faults.empty()) {
    if (auto added = drive::add_faults(*scenario, arguments.faults); !added) return complain(added.error());
  }
  if (arguments.seed) scenario->seed = *arguments.seed;
  CommandFiles files;
  files.reads("LOG", arguments.log);
  files.reads(drive::inputs_of(*scenario));
  declare(arguments.reports, files);
  if (auto fine = files.check(); !fine) return complain(fine.error());
  const auto kept = frames_for(arguments.reports);
  auto run = drive::judge_recording(*scenario, arguments.log, kept.get());
  if (!run) return complain(run.error());
  run->frames = kept;
  catch_interrupts();
  report::judge_by_programs(*scenario, *run, interrupted);
  if (auto written = write_reports(arguments.reports, *scenario, *run); !written)
    return complain(written.error());
  return exit_code(run->verdict.outcome);
}

void add_convert(command_line::Command app, int& code) {
  auto arguments = std::make_shared<ConvertArguments>();
  const auto log = app.add_subcommand("log", "recorded frames: in another format, beside another recording");
  const auto command = log.add_subcommand("convert", "write a log in another format");
  command.add_option("FROM", arguments->from, log_to_read).required();
  command.add_option("TO", arguments->to, "the new file").required();
  command
      .add_option(
          "--format", arguments->format,
          "format of TO (default: by its ending: .log, .txt or .candump for candump, .asc, .blf, .pcap)")
      .one_of({"candump", "asc", "blf", "pcap"});
  add_log_compare(log, code);
  log.require_subcommands(1, 1);
  command.on_given([&code, arguments] { code = static_cast<int>(convert(*arguments)); });
}

void add_replay(command_line::Command app, int& code) {
  auto arguments = std::make_shared<ReplayArguments>();
  const auto command = app.add_subcommand("replay", "send the frames of a log again, at their times");
  command.add_option("LOG", arguments->log, log_to_read).required();
  command.add_option("--bus", arguments->bus, "can0, vcan0: SocketCAN; local:NAME: embedded bus");
  command
      .add_option(
          "--channel", arguments->channels,
          "INTERFACE: send only the frames that the log has of this interface; INTERFACE=BUS: on this bus; "
          "may be given again (default: the only one that the log has)")
      .one_word_each();
  command.add_number("--speed", arguments->speed, "so many times as fast (default: 1)", slowest, fastest);
  command.add_number("--loop", arguments->loops, "how often; 0: until interrupted (default: 1)");
  command.add_option("--only", arguments->only, "id in hexadecimal digits; may be given again (default: all)")
      .one_word_each();
  command
      .add_option("--direction", arguments->direction,
                  "sent: what the recorder sent; received: what it received (default: both)")
      .one_of({"both", "sent", "received"});
  command.add_flag("--fd", arguments->fd, "carry CAN FD frames");
  command.on_given([&code, arguments] { code = static_cast<int>(replay(*arguments)); });
}

void add_check(command_line::Command app, int& code) {
  auto arguments = std::make_shared<CheckArguments>();
  const auto command =
      app.add_subcommand("check", "judge the log of a run by its scenario; timing is not measured");
  command.add_option("LOG", arguments->log, "log of a run (hil-bench run --log)").required();
  command.add_option("SCENARIO", arguments->scenario, "scenario file (TOML), its checks may have changed")
      .required();
  command.add_number("--seed", arguments->seed, "of the run, where it was another than the scenario's");
  command
      .add_option("--set", arguments->settings,
                  "KEY=VALUE: a value that the run had in place of the scenario's")
      .one_word_each();
  command.add_option("--faults", arguments->faults, "file of [[fault]] tables that the run had in addition");
  add_reports(command, arguments->reports);
  command.on_given([&code, arguments] { code = static_cast<int>(check(*arguments)); });
}

}  // namespace

void add_log(command_line::Command app, int& code) {
  add_convert(app, code);
  add_decode(app, code);
  add_replay(app, code);
  add_check(app, code);
}

}  // namespace canhil::commands
