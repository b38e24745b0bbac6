#include "bench/accept/accept.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ctime>
#include <filesystem>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bench/accept/report.hpp"
#include "bench/campaign/campaign.hpp"
#include "bench/commands/campaign.hpp"
#include "bench/commands/exit_code.hpp"
#include "bench/commands/interrupt.hpp"
#include "bench/commands/program.hpp"
#include "bench/commands/progress_line.hpp"
#include "bench/commands/reports.hpp"
#include "bench/drive/inputs.hpp"
#include "bench/drive/run_files.hpp"
#include "bench/drive/target_command.hpp"
#include "bench/processes/command.hpp"
#include "bench/report/file.hpp"
#include "bench/scenario/commands.hpp"
#include "dbc/files/command_files.hpp"

namespace canhil::commands {
namespace {

namespace fs = std::filesystem;

// The arguments as given on the command line.
struct Arguments {
  std::string suites = data_folder("acceptance");
  std::string target = processes::quoted_word(own_folder() + "/hil-target");
  std::vector<std::string> estimators, families;
  std::optional<std::uint64_t> seed;
  std::optional<std::uint64_t> share;
  std::optional<std::uint64_t> threads;
  std::string same_as;
  bool first = false, no_commands = false;
  std::string json, junit, html;
};

Result<std::vector<accept::Suite>> read(const Arguments& arguments) {
  const auto folders = accept::suites_in(arguments.suites);
  if (!folders) return tl::unexpected(folders.error());
  std::vector<accept::Suite> suites;
  std::vector<std::string> names;
  for (const fs::path& folder : *folders) {
    auto suite = accept::read_suite(folder);
    if (!suite) return tl::unexpected(suite.error());
    if (std::ranges::find(names, suite->estimator) != names.end())
      return failure(fmt::format("{}: is a second suite of {}, expected one suite for each estimator",
                                 folder.string(), suite->estimator));
    names.push_back(suite->estimator);
    const auto& wanted = arguments.estimators;
    if (wanted.empty() || std::ranges::find(wanted, suite->estimator) != wanted.end())
      suites.push_back(std::move(*suite));
  }
  for (const std::string& name : arguments.families) {
    if (std::ranges::find(accept::families, name) == accept::families.end())
      return failure(fmt::format("--family '{}': is unknown, expected one of: {}", name,
                                 fmt::join(accept::families, ", ")));
  }
  if (!arguments.same_as.empty() && arguments.same_as != "hil-target")
    return failure(fmt::format("--same-as '{}': is unknown, expected hil-target", arguments.same_as));
  if (arguments.share && arguments.same_as.empty())
    return failure("--tolerance: is for the comparison with hil-target, expected --same-as hil-target too");
  const auto compared = [](const accept::Suite& suite) {
    return std::ranges::any_of(suite.flights, [](const auto& one) { return one.reference.has_value(); });
  };
  if (!arguments.same_as.empty() && !suites.empty() && std::ranges::none_of(suites, compared))
    return failure(
        fmt::format("--same-as {}: no flight of the suites in {} is compared, expected one with the "
                    "key 'reference'",
                    arguments.same_as, arguments.suites));
  for (const std::string& name : arguments.estimators) {
    if (std::ranges::find(names, name) == names.end())
      return failure(fmt::format("--estimator '{}': has no suite in {}, expected one of: {}", name,
                                 arguments.suites, fmt::join(names, ", ")));
  }
  return suites;
}

using Files = std::vector<CommandFiles::File>;

// The target's program, all files of the suites, and what their flights and campaigns read in addition.
Result<Files> inputs_of(const Arguments& arguments, const std::vector<accept::Suite>& suites) {
  Files inputs = drive::inputs_of_target(arguments.target);
  const auto add = [&inputs](const Files& more) { std::ranges::copy(more, std::back_inserter(inputs)); };
  std::error_code unknown;
  for (const accept::Suite& suite : suites) {
    for (const auto& entry : fs::recursive_directory_iterator(suite.folder, unknown)) {
      if (entry.is_regular_file(unknown)) inputs.push_back({"suite", entry.path().string()});
    }
    for (const accept::Flight& flight : suite.flights) add(drive::inputs_of(flight.scenario));
    if (suite.dialogue) add(drive::inputs_of(*suite.dialogue));
    for (const std::string& name : suite.campaigns) {
      const auto campaign = campaign::read_campaign(suite.folder / name);
      if (!campaign) return tl::unexpected(campaign.error());
      add(campaign::inputs_of(*campaign));
    }
  }
  return inputs;
}

// No output may replace an input, nor a file of a suite that is not asked about.
Result<void> check_files(const Arguments& arguments, const Files& inputs) {
  CommandFiles files;
  files.reads(inputs);
  std::error_code unknown;
  for (const auto& entry : fs::recursive_directory_iterator(arguments.suites, unknown)) {
    if (entry.is_regular_file(unknown)) files.reads("suite", entry.path().string());
  }
  files.writes("--json", arguments.json);
  files.writes("--junit", arguments.junit);
  files.writes_file("--html", arguments.html);
  return files.check();
}

// The bench and its inputs, with their hashes, each once.
std::vector<drive::RunFile> identified(const Files& inputs) {
  Files named{{"bench", "/proc/self/exe"}};
  std::ranges::copy(inputs, std::back_inserter(named));
  std::vector<drive::RunFile> files;
  std::set<std::string> seen;
  std::error_code unknown;
  for (const CommandFiles::File& one : named) {
    const fs::path path = fs::weakly_canonical(one.path, unknown);
    if (!seen.insert(path.string()).second) continue;
    if (auto identity = drive::identify_file(path.string()))
      files.push_back({.role = one.role, .name = path.string(), .identity = std::move(*identity)});
  }
  return files;
}

Result<void> write_reports(const Arguments& arguments, const accept::Report& all) {
  if (arguments.json != report::to_stdout && arguments.junit != report::to_stdout) {
    if (auto shown = report::show(accept::text(all)); !shown) return shown;
  }
  if (!arguments.json.empty()) {
    if (auto written = report::write(arguments.json, accept::json(all)); !written) return written;
  }
  if (!arguments.junit.empty()) {
    if (auto written = report::write(arguments.junit, accept::junit(all)); !written) return written;
  }
  return arguments.html.empty() ? Result<void>{} : report::write_file(arguments.html, accept::page(all));
}

ExitCode execute(const Arguments& arguments) {
  if (auto fine = drive::check_target(arguments.target); !fine) return complain(fine.error());
  if (arguments.no_commands) scenario::forbid_commands();
  const auto suites = read(arguments);
  if (!suites) return complain(suites.error());
  const auto inputs = inputs_of(arguments, *suites);
  if (!inputs) return complain(inputs.error());
  if (auto fine = check_files(arguments, *inputs); !fine) return complain(fine.error());
  catch_interrupts();
  const ProgressLine line;
  const auto progress = [&](const std::string& what) { line.show([&] { return what; }); };
  accept::Report all{.target = arguments.target,
                     .same_as = arguments.same_as,
                     .tolerance = static_cast<double>(arguments.share.value_or(1)),
                     .families = arguments.families,
                     .seed = arguments.seed,
                     .files = identified(*inputs),
                     .started_s = std::time(nullptr),
                     .suites = {}};
  for (const accept::Suite& suite : *suites) {
    accept::Options options{.target = arguments.target, .seed = arguments.seed};
    options.same_as_hil_target = !arguments.same_as.empty();
    options.share = static_cast<double>(arguments.share.value_or(1));
    options.threads = static_cast<unsigned>(arguments.threads.value_or(0));
    options.first_failure = arguments.first;
    options.families = arguments.families;
    options.begun = [&] {
      remove_earlier({.json = arguments.json, .junit = arguments.junit, .html = arguments.html, .csv = {}});
    };
    options.progress = progress;
    auto one = accept::accept(suite, options, interrupted);
    if (!one) return end_with(one.error());
    if (one->findings.empty()) continue;  // none of the selected families is in this suite
    all.suites.push_back(std::move(*one));
    if (interrupted || (arguments.first && all.outcome() == checks::Outcome::fail)) break;
  }
  line.clear();
  if (interrupted) return end_interrupted();
  if (auto written = write_reports(arguments, all); !written) return complain(written.error());
  return exit_code(all.outcome());
}

}  // namespace

void add_accept(command_line::Command app, int& code) {
  auto arguments = std::make_shared<Arguments>();
  const auto command = app.add_subcommand(std::string(accept_name), std::string(accept_summary));
  command.add_option("--target", arguments->target,
                     "program and its arguments, as one word (default: hil-target beside hil-bench)");
  command
      .add_option("--estimator", arguments->estimators, "only its suite; may be given again (default: all)")
      .one_word_each();
  command.add_option("--suites", arguments->suites, "folder of suites (default: those of the project)");
  command.add_number("--seed", arguments->seed, "of the campaigns, in place of their own");
  command.add_option("--same-as", arguments->same_as,
                     "hil-target: also ask whether the answers are those of hil-target's code");
  command.add_number("--tolerance", arguments->share,
                     "with --same-as: multiplies by how much an answer may differ (default: 1)", 1,
                     1'000'000);
  command.add_number("--threads", arguments->threads,
                     "the number of flights in lockstep at the same time (default: one a core)", 1,
                     most_threads);
  command.add_flag("--first-failure", arguments->first, "stop at the first requirement that is not met");
  command
      .add_option("--family", arguments->families,
                  fmt::format("only requirements of this family; may be given again: {}",
                              fmt::join(accept::families, ", ")))
      .one_word_each();
  command.add_flag("--no-commands", arguments->no_commands,
                   "refuse scenarios that execute something: commands, programs, FMUs");
  command.add_option("--json", arguments->json,
                     "write the report as JSON to a file; -: to stdout, in place of the text");
  command.add_option("--junit", arguments->junit,
                     "write it as JUnit XML to a file; -: to stdout, in place of the text");
  command.add_option("--html", arguments->html, "write it as one HTML page to a file");
  command.on_given([&code, arguments] { code = static_cast<int>(execute(*arguments)); });
}

}  // namespace canhil::commands
