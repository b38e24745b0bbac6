#include "bench/conformance/conformance.hpp"
#include "bench/commands/conformance_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bench/commands/exit_code.hpp"
#include "bench/commands/interrupt.hpp"
#include "bench/commands/program.hpp"
#include "bench/commands/progress_line.hpp"
#include "bench/commands/subcommands.hpp"
#include "bench/drive/contract.hpp"
#include "bench/drive/inputs.hpp"
#include "bench/drive/target_command.hpp"
#include "bench/processes/command.hpp"
#include "bench/report/file.hpp"
#include "dbc/files/command_files.hpp"

namespace canhil::commands {
namespace {

namespace fs = std::filesystem;

// The arguments as given on the command line.
struct Arguments {
  std::string target = processes::quoted_word(own_folder() + "/hil-target");
  std::string estimator;  // empty: the estimator that the target's heartbeat names; if it names none, the
                          // first estimator that the target accepts
  std::string scenario;   // empty: the project's short flight of the estimator
  std::string json, junit;
};

// The project's short flights: one for each estimator.
Result<std::vector<scenario::Scenario>> quick_flights() {
  std::vector<fs::path> files;
  std::error_code error;
  const std::string folder = data_folder("flights");
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().filename().string().ends_with("_quick.toml")) files.push_back(entry.path());
  }
  if (files.empty()) return failure(fmt::format("{}: has no flights, expected --scenario FILE", folder));
  std::ranges::sort(files);
  std::vector<scenario::Scenario> flights;
  for (const fs::path& file : files) {
    auto flight = scenario::read_file(file, drive::contract());
    if (!flight) return tl::unexpected(flight.error());
    flights.push_back(std::move(*flight));
  }
  return flights;
}

Result<std::vector<scenario::Scenario>> candidates(const Arguments& arguments) {
  std::vector<scenario::Scenario> all;
  if (arguments.scenario.empty()) {
    auto flights = quick_flights();
    if (!flights) return flights;
    all = std::move(*flights);
  } else {
    auto own = scenario::read_file(arguments.scenario, drive::contract());
    if (!own) return tl::unexpected(own.error());
    all.push_back(std::move(*own));
  }
  std::vector<std::string> names;
  for (const scenario::Scenario& one : all) names.push_back(one.targets.front().estimator);
  if (arguments.estimator.empty()) return all;
  std::erase_if(all, [&](const auto& one) { return one.targets.front().estimator != arguments.estimator; });
  if (all.empty())
    return failure(fmt::format("--estimator '{}': has no flight, expected one of: {}", arguments.estimator,
                               fmt::join(names, ", ")));
  return all;
}

Result<void> check_files(const Arguments& arguments, const std::vector<scenario::Scenario>& flights) {
  CommandFiles files;
  files.reads(drive::inputs_of_target(arguments.target));
  for (const scenario::Scenario& flight : flights) files.reads(drive::inputs_of(flight));
  files.writes("--json", arguments.json);
  files.writes("--junit", arguments.junit);
  return files.check();
}

Result<void> write_reports(const Arguments& arguments, const conformance::Report& found) {
  if (arguments.json != report::to_stdout && arguments.junit != report::to_stdout) {
    if (auto shown = report::show(conformance::text(found)); !shown) return shown;
  }
  if (!arguments.json.empty()) {
    if (auto written = report::write(arguments.json, conformance::json(found)); !written) return written;
  }
  return arguments.junit.empty() ? Result<void>{} : report::write(arguments.junit, conformance::junit(found));
}

ExitCode execute(const Arguments& arguments) {
  if (auto fine = drive::check_target(arguments.target); !fine) return complain(fine.error());
  const auto flights = candidates(arguments);
  if (!flights) return complain(flights.error());
  if (auto fine = check_files(arguments, *flights); !fine) return complain(fine.error());
  catch_interrupts();
  const auto started = std::chrono::steady_clock::now();
  const auto chosen = conformance::subject_of(*flights, arguments.target, interrupted);
  if (!chosen) return end_with(chosen.error());
  conformance::Report found{.target = arguments.target,
                            .estimator = chosen->targets.front().estimator,
                            .algorithm = chosen->targets.front().algorithm,
                            .rules = {},
                            .started_s = std::time(nullptr)};
  const ProgressLine line;
  auto rules = conformance::ask(
      conformance::rules(false, false), *chosen, arguments.target, {}, std::nullopt, interrupted,
      [&](const conformance::Rule& rule) { line.show([&] { return std::string(rule.id); }); });
  line.clear();
  if (!rules) return end_with(rules.error());
  if (interrupted) return end_interrupted();
  found.rules = std::move(*rules);
  found.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (auto written = write_reports(arguments, found); !written) return complain(written.error());
  return exit_code(found.outcome());
}

}  // namespace

void add_conformance(command_line::Command app, int& code) {
  auto arguments = std::make_shared<Arguments>();
  const auto command = app.add_subcommand(
      "conformance", "whether a target keeps the protocol, rule by rule, whatever it estimates");
  command.add_option("--target", arguments->target,
                     "program and its arguments, as one word (default: hil-target beside hil-bench)");
  command.add_option(
      "--estimator", arguments->estimator,
      "as which it is talked to (default: what its heartbeat names, else the first that it takes)");
  command.add_option("--scenario", arguments->scenario,
                     "its inputs in flight (default: the quick flight of the estimator)");
  command.add_option("--json", arguments->json,
                     "write the report as JSON to a file; -: to stdout, in place of the text");
  command.add_option("--junit", arguments->junit,
                     "write it as JUnit XML to a file; -: to stdout, in place of the text");
  command.on_given([&code, arguments] { code = static_cast<int>(execute(*arguments)); });
}

}  // namespace canhil::commands
