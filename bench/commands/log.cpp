// hil-bench log, replay, check: commands for recorded frames.
#include <fmt/format.h>

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
#include "bench/drive/recording.hpp"
#include "bench/recordings/convert.hpp"
#include "bench/recordings/replay.hpp"
#include "bench/report/file.hpp"
#include "dbc/files/command_files.hpp"
#include "dbc/ports/fd_groups.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil::commands {
namespace {

constexpr double slowest = 1e-3, fastest = 1e3;

// The arguments as given on the command line.
struct ReplayArguments {
  std::string log, bus, direction = "both";
  double speed = 1;
  std::optional<std::uint64_t> loops;
  std::vector<std::string> only;
  bool fd = false;
};
struct CheckArguments {
  std::string log, scenario;
  std::optional<std::uint64_t> seed;
  std::string faults;
  Reports reports;
};

ExitCode convert(const std::string& from, const std::string& to) {
  CommandFiles files;
  files.reads("FROM", from);
  files.writes_file("TO", to);
  if (auto fine = files.check(); !fine) return complain(fine.error());
  const auto frames = recordings::convert(from, to);
  if (!frames) return complain(frames.error());
  fmt::print("{}: {} frames\n", one_line(to), *frames);
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

ExitCode replay(const ReplayArguments& arguments) {
  const auto ids = ids_of(arguments.only);
  if (!ids) return complain(ids.error());
  if (auto reader = LogReader::open(arguments.log); !reader) return complain(reader.error());
  auto port = join_or_host(arguments.bus, {.fd = arguments.fd, .node_name = "hil-bench replay"},
                           arguments.fd ? BusFormat::fd_frames : BusFormat::classic);
  if (!port) return complain(port.error());
  catch_interrupts();
  const auto replayed = [&] {
    const ProgressLine line;
    return recordings::replay(
        **port, arguments.log,
        {.speed = arguments.speed,
         .loops = arguments.loops.value_or(1),
         .only = *ids,
         .transmitted =
             arguments.direction == "both" ? std::nullopt : std::optional(arguments.direction == "sent")},
        interrupted, [&](std::uint64_t frames) {
          if (frames % 256 == 0) line.show([&] { return fmt::format("{} frames", frames); });
        });
  }();
  if (!replayed) return complain(replayed.error());
  const checks::Histogram& late = replayed->lateness;
  fmt::print("{} frames on {}; late by {:.0f} us (median), {:.0f} us (99 %), {:.0f} us (most)\n",
             replayed->frames, one_line(arguments.bus), late.quantile_ns(0.5) / 1e3,
             late.quantile_ns(0.99) / 1e3, static_cast<double>(late.max_ns()) / 1e3);
  return ExitCode::pass;
}

ExitCode check(const CheckArguments& arguments) {
  auto scenario = drive::read_scenario(arguments.scenario);
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
  const auto run = drive::judge_recording(*scenario, arguments.log);
  if (!run) return complain(run.error());
  if (auto written = write_reports(arguments.reports, *scenario, *run); !written)
    return complain(written.error());
  return exit_code(run->verdict.outcome);
}

void add_convert(command_line::Command app, int& code) {
  auto names = std::make_shared<std::pair<std::string, std::string>>();
  const auto log = app.add_subcommand("log", "recorded frames: in another format, beside another recording");
  const auto command = log.add_subcommand(
      "convert", "write a log in another format: *.log (candump), *.pcap (Wireshark), *.asc (Vector)");
  command.add_option("FROM", names->first, "log of any of these formats").required();
  command.add_option("TO", names->second, "the new file").required();
  add_log_compare(log, code);
  log.require_subcommands(1, 1);
  command.on_given([&code, names] { code = static_cast<int>(convert(names->first, names->second)); });
}

void add_replay(command_line::Command app, int& code) {
  auto arguments = std::make_shared<ReplayArguments>();
  const auto command = app.add_subcommand("replay", "send the frames of a log again, at their times");
  command.add_option("LOG", arguments->log, "log: candump's format, pcap or Vector ASC").required();
  command.add_option("--bus", arguments->bus, "can0, vcan0: SocketCAN; local:NAME: embedded bus").required();
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
