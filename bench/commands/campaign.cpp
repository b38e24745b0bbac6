#include "bench/commands/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/campaign/export.hpp"
#include "bench/campaign/flights.hpp"
#include "bench/campaign/merge.hpp"
#include "bench/campaign/shards.hpp"
#include "bench/commands/campaign_flight.hpp"
#include "bench/commands/exit_code.hpp"
#include "bench/commands/interrupt.hpp"
#include "bench/commands/program.hpp"
#include "bench/commands/reports.hpp"
#include "bench/drive/kept_frames.hpp"
#include "bench/drive/session.hpp"
#include "bench/observe/recorder.hpp"
#include "bench/papers/names.hpp"
#include "bench/report/file.hpp"
#include "bench/report/program_checks.hpp"
#include "bench/scenario/commands.hpp"
#include "bench/scenario/nearest.hpp"
#include "dbc/files/command_files.hpp"

namespace canhil::commands {
namespace {

namespace fs = std::filesystem;

// The arguments as given on the command line.
struct Arguments {
  std::string file;
  std::optional<std::uint64_t> runs;
  bool unrounded = false;
  bool no_commands = false;
  CampaignFlight flight;
};
struct MergeArguments {
  std::string out;
  std::vector<std::string> shards;
};
struct ReportArguments {
  std::vector<std::string> files;
  CampaignReports reports;
};
struct PaperArguments {
  std::string paper;
  std::string exact;
};
struct ExportArguments {
  std::string results;
  std::string format = "csv";
  campaign::Chosen chosen;
};
struct ReplayArguments {
  std::string file;
  std::optional<std::uint64_t> run;
  std::string variant;
  std::string log;
  bool no_commands = false;
  Reports reports;
};

ExitCode execute(const Arguments& arguments) {
  if (arguments.no_commands) scenario::forbid_commands();
  auto campaign = campaign::read_campaign(arguments.file);
  if (!campaign) return complain(campaign.error());
  if (arguments.runs) campaign->runs = *arguments.runs;
  campaign->rounding = arguments.unrounded ? Rounding::none : Rounding::as_on_the_bus;
  return fly(*campaign, arguments.flight, fs::path(arguments.file).stem().string());
}

ExitCode merge(const MergeArguments& arguments) {
  const std::vector<fs::path> shards(arguments.shards.begin(), arguments.shards.end());
  CommandFiles files;
  for (const fs::path& shard : shards) files.reads("shard", shard.string());
  files.writes_file("OUT", arguments.out);
  if (auto fine = files.check(); !fine) return complain(fine.error());
  const auto merged = campaign::merge(arguments.out, shards);
  return merged ? ExitCode::pass : complain(merged.error());
}

ExitCode export_results(const ExportArguments& arguments) {
  const auto store = campaign::Store::open(arguments.results);
  if (!store) return complain(store.error());
  const auto campaign = campaign::campaign_of(*store);
  if (!campaign) return complain(campaign.error());
  const auto exported = campaign::export_csv(*campaign, *store, arguments.chosen, report::write_stdout);
  return exported ? ExitCode::pass : complain(exported.error());
}

// The index of the variant with this name; empty: the first.
Result<std::size_t> variant_named(const campaign::Campaign& campaign, const std::string& name) {
  if (name.empty()) return 0;
  const auto found = std::ranges::find(campaign.variants, name, &campaign::Variant::name);
  if (found != campaign.variants.end()) return static_cast<std::size_t>(found - campaign.variants.begin());
  std::vector<std::string> names;
  for (const auto& known : campaign.variants) names.push_back(known.name);
  return failure(fmt::format("{}: variant '{}' is unknown, expected {}", campaign.sources.file, name,
                             scenario::expected_instead(name, names)));
}

ExitCode replay(const ReplayArguments& arguments) {
  if (arguments.no_commands) scenario::forbid_commands();
  const auto campaign = campaign::read_campaign(arguments.file);
  if (!campaign) return complain(campaign.error());
  const auto variant = variant_named(*campaign, arguments.variant);
  if (!variant) return complain(variant.error());
  if (*arguments.run >= campaign->runs) {
    return complain({fmt::format("{}: run {} is not in the campaign, expected 0 to {}", arguments.file,
                                 *arguments.run, campaign->runs - 1)});
  }
  const auto scenario = campaign::scenario_of(*campaign, {.variant = *variant, .run = *arguments.run});
  if (!scenario) return complain(scenario.error());
  drive::Options options = drive::unattended("", *scenario);
  if (!campaign->matrix) options.run_index = *arguments.run;
  CommandFiles files;
  files.reads(campaign::inputs_of(*campaign));
  files.writes_file("--log", arguments.log);
  if (!arguments.log.empty()) {
    files.may_write("incomplete log", observe::incomplete_log(arguments.log));
    options.log_path = arguments.log;
  }
  declare(arguments.reports, files);
  if (auto fine = files.check(); !fine) return complain(fine.error());
  const auto kept = frames_for(arguments.reports);
  if (kept) options.onlookers.push_back(kept.get());
  catch_interrupts();
  auto finished = drive::run(*scenario, options, interrupted, [](std::int64_t) {});
  if (!finished) return end_with(finished.error());
  finished->frames = kept;
  report::judge_by_programs(*scenario, *finished, interrupted);
  if (arguments.reports.json != report::to_stdout && arguments.reports.junit != report::to_stdout) {
    if (auto shown = report::show(fmt::format("variant {} · run {}\n",
                                              one_line(campaign->variants[*variant].name), *arguments.run));
        !shown)
      return complain(shown.error());
  }
  if (auto written = write_reports(arguments.reports, *scenario, *finished); !written)
    return complain(written.error());
  return exit_code(finished->verdict.outcome);
}

void add_merge(command_line::Command campaign, int& code) {
  auto arguments = std::make_shared<MergeArguments>();
  const auto command =
      campaign.add_subcommand("merge", "put shards together: the same bytes for any division");
  command.add_option("OUT", arguments->out, "file to write (SQLite)").required();
  command.add_option("SHARD", arguments->shards, "results of the shards").required();
  command.on_given([&code, arguments] { code = static_cast<int>(merge(*arguments)); });
}

void add_report(command_line::Command campaign, int& code) {
  auto arguments = std::make_shared<ReportArguments>();
  const auto command = campaign.add_subcommand("report", "answer the campaign's questions from its results");
  command
      .add_option("RESULTS", arguments->files,
                  "merged results, those of an undivided campaign, or all shards")
      .required();
  add_reports(command, arguments->reports);
  command.on_given(
      [&code, arguments] { code = static_cast<int>(report_on(arguments->files, arguments->reports)); });
}

void add_export(command_line::Command campaign, int& code) {
  auto arguments = std::make_shared<ExportArguments>();
  const auto command = campaign.add_subcommand("export", "results as a table: variant, run, time, quantity");
  command.add_option("RESULTS", arguments->results, "results of a campaign, or of a shard").required();
  command.add_option("--format", arguments->format, "csv (default)");
  command
      .add_option("--variant", arguments->chosen.variants,
                  "only of this variant; may be repeated (default: all)")
      .one_word_each();
  command
      .add_option("--quantity", arguments->chosen.quantities,
                  "only this quantity; may be repeated (default: all)")
      .one_word_each();
  command.add_number("--from", arguments->chosen.from_s, "only from this time on [s]", -campaign::any_time_s,
                     campaign::any_time_s);
  command.add_number("--to", arguments->chosen.to_s, "only up to this time [s]", -campaign::any_time_s,
                     campaign::any_time_s);
  command.on_given([&code, arguments] {
    code = static_cast<int>(
        arguments->format == "csv"
            ? export_results(*arguments)
            : complain({fmt::format("--format '{}': is unknown, expected 'csv'", arguments->format)}));
  });
}

void add_replay(command_line::Command campaign, int& code) {
  auto arguments = std::make_shared<ReplayArguments>();
  const auto command =
      campaign.add_subcommand("replay", "one run again, with its checks, its reports and its frames");
  command.add_option("FILE", arguments->file, "campaign file (TOML)").required();
  command.add_number("RUN", arguments->run, "index of the run, from 0").required();
  command.add_option("--variant", arguments->variant, "by name (default: the first)");
  command.add_option("--log", arguments->log, "record every frame in candump's log format");
  add_reports(command, arguments->reports);
  command.add_flag("--no-commands", arguments->no_commands,
                   "refuse scenarios that execute something: commands, programs, FMUs");
  command.on_given([&code, arguments] { code = static_cast<int>(replay(*arguments)); });
}

// Replaces this process by hil-bench-paper, the program that reproduces a paper.
int reproduce(const PaperArguments& paper, const Arguments& arguments) {
  std::vector<std::string> words{paper.paper};
  if (!arguments.flight.out.empty()) words.insert(words.end(), {"--out", arguments.flight.out});
  if (arguments.runs) words.insert(words.end(), {"--runs", std::to_string(*arguments.runs)});
  if (arguments.unrounded) words.emplace_back("--unrounded");
  if (!paper.exact.empty()) words.insert(words.end(), {"--exact", paper.exact});
  return become("hil-bench-paper", words);
}

}  // namespace

void add_campaign(command_line::Command app, int& code) {
  auto arguments = std::make_shared<Arguments>();
  const auto command = app.add_subcommand(std::string(campaign_name), std::string(campaign_summary));
  const auto file = command.add_option("FILE", arguments->file, "campaign file (TOML)");
  command.add_number("--runs", arguments->runs, "another number of runs than the campaign's", 1,
                     campaign::most_runs);
  const auto options = add_flight(command, arguments->flight);
  const auto unrounded =
      command.add_flag("--unrounded", arguments->unrounded,
                       "frames that round nothing: the difference is what the bus's resolution costs");
  const auto no_commands =
      command.add_flag("--no-commands", arguments->no_commands,
                       "refuse scenarios that execute something: commands, programs, FMUs");
  options.target.excludes(unrounded);
  auto paper = std::make_shared<PaperArguments>();
  const auto name =
      command.add_option("--paper", paper->paper,
                         "in place of FILE: what a paper claims, with a page of figures: " + papers::names());
  command.add_option("--exact", paper->exact, "with --paper: results without the bus's rounding, to compare")
      .needs(name);
  name.excludes(file);
  for (const auto& option : options.own) name.excludes(option);
  name.excludes(no_commands);
  command.require_subcommands(0, 1);
  add_merge(command, code);
  add_report(command, code);
  add_export(command, code);
  add_replay(command, code);
  command.on_given([&code, arguments, paper, command, file, name] {
    if (command.subcommand_given()) return;
    if (name.given()) {
      code = reproduce(*paper, *arguments);
      return;
    }
    if (!file.given()) command_line::throw_required("FILE, or merge, report, export or replay");
    code = static_cast<int>(execute(*arguments));
  });
}

}  // namespace canhil::commands
