#include "bench/commands/campaign.hpp"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/campaign/evaluate.hpp"
#include "bench/campaign/execute.hpp"
#include "bench/campaign/export.hpp"
#include "bench/campaign/merge.hpp"
#include "bench/campaign/report.hpp"
#include "bench/commands/campaign_course.hpp"
#include "bench/commands/exit_code.hpp"
#include "bench/commands/interrupt.hpp"
#include "bench/commands/live.hpp"
#include "bench/commands/program.hpp"
#include "bench/commands/progress_line.hpp"
#include "bench/drive/inputs.hpp"
#include "bench/drive/session.hpp"
#include "bench/observe/recorder.hpp"
#include "bench/papers/names.hpp"
#include "bench/report/file.hpp"
#include "bench/report/run_reports.hpp"
#include "bench/report/signature.hpp"
#include "bench/scenario/commands.hpp"
#include "dbc/files/command_files.hpp"

namespace canhil::commands {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_threads = 1024;

// The arguments as given on the command line.
struct Arguments {
  std::string file;
  std::string out;
  std::optional<std::uint64_t> threads;
  std::string shard;
  std::optional<std::uint64_t> runs;
  bool resume = false;
  bool unrounded = false;
  bool no_commands = false;
  std::string target;
  std::string json;
  Live live;
};
struct MergeArguments {
  std::string out;
  std::vector<std::string> shards;
};
struct ReportArguments {
  std::string merged;
  bool json = false;
};
struct PaperArguments {
  std::string paper;
  std::string exact;
};
struct ExportArguments {
  std::string results;
  std::string format = "csv";
};
struct ReplayArguments {
  std::string file;
  std::optional<std::uint64_t> run;
  std::string variant;
  std::string log;
  bool no_commands = false;
};

// A text such as "[===   ] 300 / 1200 runs · 812.1/s · 1 s left".
std::string progress_text(const campaign::Progress& progress, double elapsed_s) {
  const auto done = static_cast<double>(progress.done), total = static_cast<double>(progress.total);
  std::string text =
      fmt::format("{} {} / {} runs", progress_bar(done / total), progress.done, progress.total);
  if (progress.done > 0) {
    const double rate = done / elapsed_s;
    text += fmt::format(" · {:.1f}/s · {:.0f} s left", rate, (total - done) / rate);
  }
  return text;
}

// --out names the results file (*.sqlite) or a folder for it. In a folder, the file is named after the
// campaign and the shard.
Result<fs::path> results_file(const Arguments& arguments, const campaign::Shard& shard) {
  const fs::path out = arguments.out;
  if (out == report::to_stdout) return failure("--out -: expected a folder or a file, not standard output");
  if (out.extension() == ".sqlite") return out;
  const std::string stem = fs::path(arguments.file).stem().string();
  return out / (shard.count == 1 ? stem + ".sqlite"
                                 : fmt::format("{}-{}-of-{}.sqlite", stem, shard.index, shard.count));
}

Result<void> make_folder(const Arguments& arguments) {
  const fs::path out = arguments.out;
  std::error_code error;
  if (!out.empty() && out.extension() != ".sqlite") fs::create_directories(out, error);
  if (error) return failure(fmt::format("{}: cannot be a folder: {}", out.string(), error.message()));
  return {};
}

ExitCode print_report(const campaign::Campaign& campaign, const fs::path& file, const std::string& json) {
  const auto store = campaign::Store::open(file);
  if (!store) return complain(store.error());
  const auto evaluation = campaign::evaluate(campaign, *store);
  if (!evaluation) return complain(evaluation.error());
  if (json != report::to_stdout) {
    if (auto shown = report::show(campaign::text(campaign, *evaluation)); !shown)
      return complain(shown.error());
  }
  if (!json.empty()) {
    if (auto written = report::write(json, campaign::json(campaign, *evaluation)); !written)
      return complain(written.error());
  }
  if (const std::string why = evaluation->not_judged(); !why.empty())
    complain({fmt::format("{}: {}", campaign.sources.file, why)});
  return exit_code(evaluation->outcome());
}

Rounding rounding_of(const Arguments& arguments) {
  return arguments.unrounded ? Rounding::none : Rounding::as_on_the_bus;
}

ExitCode execute(const Arguments& arguments) {
  if (arguments.no_commands) scenario::forbid_commands();
  auto campaign = campaign::read_campaign(arguments.file);
  if (!campaign) return complain(campaign.error());
  if (arguments.runs) campaign->runs = *arguments.runs;
  campaign->rounding = rounding_of(arguments);
  const auto shard =
      arguments.shard.empty() ? campaign::shard_of_environment() : campaign::parse_shard(arguments.shard);
  if (!shard) return complain(shard.error());
  if (!arguments.target.empty()) {
    if (auto fine = drive::check_target(arguments.target); !fine) return complain(fine.error());
  }
  const auto file = results_file(arguments, *shard);
  if (!file) return complain(file.error());
  if (!arguments.json.empty() && shard->count > 1)
    return complain({"--json: a shard has no report, expected all runs: merge them first"});
  CommandFiles files;
  files.reads(campaign::inputs_of(*campaign));
  files.reads(drive::inputs_of_target(arguments.target));
  files.may_write("--out", file->string());
  files.writes("--json", arguments.json);
  if (auto distinct = files.check_distinct(); !distinct) return complain(distinct.error());
  if (auto made = make_folder(arguments); !made) return complain(made.error());
  if (auto writable = files.check_writable(); !writable) return complain(writable.error());

  auto view = OpenView::open(
      arguments.live,
      {.batch = Course::begun(campaign->sources.file, campaign->runs * campaign->variants.size())});
  if (!view) return complain(view.error());
  std::optional<Course> course;
  if (view->get() != nullptr) course.emplace(*campaign, *view->get());
  catch_interrupts();
  const auto execution = [&] {
    const ProgressLine line;
    const auto start = std::chrono::steady_clock::now();
    const auto show = [&](const campaign::Progress& progress) {
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
      if (course) course->progress(progress, elapsed.count());
      if (progress.total > 0) line.show([&] { return progress_text(progress, elapsed.count()); });
    };
    return campaign::execute(*campaign,
                             {.file = *file,
                              .shard = *shard,
                              .threads = static_cast<unsigned>(arguments.threads.value_or(0)),
                              .resume = arguments.resume,
                              .target = arguments.target,
                              .committed =
                                  [&](std::span<const campaign::Finished> runs) {
                                    if (course) course->committed(runs);
                                  },
                              .progress = show},
                             interrupted);
  }();
  if (!execution) {
    if (view->get() != nullptr) view->get()->show_ended(execution.error().message);
    return end_with(execution.error());
  }
  if (*execution == campaign::Execution::interrupted) {
    if (course) course->end(checks::Outcome::not_measured, "interrupted");
    return end_interrupted(fmt::format("; --resume goes on with {}", file->string()));
  }
  const ExitCode code = shard->count > 1 ? ExitCode::pass : print_report(*campaign, *file, arguments.json);
  if (course) course->end(outcome_of(code), shard->count > 1 ? "the shard is flown" : "");
  view->hold();
  return code;
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

// The campaign to which the stored results belong.
Result<campaign::Campaign> campaign_of(const campaign::Store& store) {
  auto campaign = campaign::parse_campaign(store.sources());
  if (!campaign) return campaign;
  campaign->runs = store.identity().runs;
  campaign->rounding = store.identity().rounding;
  return campaign;
}

ExitCode report_on(const ReportArguments& arguments) {
  const auto store = campaign::Store::open(arguments.merged);
  if (!store) return complain(store.error());
  const auto campaign = campaign_of(*store);
  if (!campaign) return complain(campaign.error());
  const ExitCode code =
      print_report(*campaign, arguments.merged, std::string(arguments.json ? report::to_stdout : ""));
  if (code != ExitCode::usage) say(report::signature_line(arguments.merged));
  return code;
}

ExitCode export_results(const ExportArguments& arguments) {
  const auto store = campaign::Store::open(arguments.results);
  if (!store) return complain(store.error());
  const auto campaign = campaign_of(*store);
  if (!campaign) return complain(campaign.error());
  const auto exported = campaign::export_csv(*campaign, *store, report::write_stdout);
  return exported ? ExitCode::pass : complain(exported.error());
}

ExitCode replay(const ReplayArguments& arguments) {
  if (arguments.no_commands) scenario::forbid_commands();
  const auto campaign = campaign::read_campaign(arguments.file);
  if (!campaign) return complain(campaign.error());
  const auto* variant = campaign->variants.data();
  if (!arguments.variant.empty()) {
    const auto found = std::ranges::find(campaign->variants, arguments.variant, &campaign::Variant::name);
    if (found == campaign->variants.end()) {
      std::string names;
      for (const auto& known : campaign->variants) names += (names.empty() ? "'" : ", '") + known.name + "'";
      return complain({fmt::format("{}: variant '{}' is unknown, expected one of {}", arguments.file,
                                   arguments.variant, names)});
    }
    variant = &*found;
  }
  if (*arguments.run >= campaign->runs) {
    return complain({fmt::format("{}: run {} is not in the campaign, expected 0 to {}", arguments.file,
                                 *arguments.run, campaign->runs - 1)});
  }
  drive::Options options;
  options.bus = drive::BusName(std::string(drive::in_process_bus));
  options.run_index = *arguments.run;
  if (!arguments.log.empty()) {
    CommandFiles files;
    files.reads(campaign::inputs_of(*campaign));
    files.writes_file("--log", arguments.log);
    files.may_write("incomplete log", observe::incomplete_log(arguments.log));
    if (auto fine = files.check(); !fine) return complain(fine.error());
    options.log_path = arguments.log;
  }
  catch_interrupts();
  const auto finished = drive::run(variant->scenario, options, interrupted, [](std::int64_t) {});
  if (!finished) return end_with(finished.error());
  if (auto shown = report::show(fmt::format("variant {} · run {}\n{}", one_line(variant->name),
                                            options.run_index, report::text(variant->scenario, *finished)));
      !shown)
    return complain(shown.error());
  if (finished->log_error) return complain(*finished->log_error);
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
  command.add_option("RESULTS", arguments->merged, "merged results, or those of an undivided campaign")
      .required();
  command.add_flag("--json", arguments->json, "as JSON, with the curves");
  command.on_given([&code, arguments] { code = static_cast<int>(report_on(*arguments)); });
}

void add_export(command_line::Command campaign, int& code) {
  auto arguments = std::make_shared<ExportArguments>();
  const auto command = campaign.add_subcommand("export", "results as a table: variant, run, time, quantity");
  command.add_option("RESULTS", arguments->results, "results of a campaign, or of a shard").required();
  command.add_option("--format", arguments->format, "csv (default)");
  command.on_given([&code, arguments] {
    code = static_cast<int>(
        arguments->format == "csv"
            ? export_results(*arguments)
            : complain({fmt::format("--format '{}': is unknown, expected 'csv'", arguments->format)}));
  });
}

void add_replay(command_line::Command campaign, int& code) {
  auto arguments = std::make_shared<ReplayArguments>();
  const auto command = campaign.add_subcommand("replay", "one run again, with its checks and its frames");
  command.add_option("FILE", arguments->file, "campaign file (TOML)").required();
  command.add_number("RUN", arguments->run, "index of the run, from 0").required();
  command.add_option("--variant", arguments->variant, "by name (default: the first)");
  command.add_option("--log", arguments->log, "record every frame in candump's log format");
  command.add_flag("--no-commands", arguments->no_commands,
                   "refuse scenarios that execute something: commands, programs, FMUs");
  command.on_given([&code, arguments] { code = static_cast<int>(replay(*arguments)); });
}

// Replaces this process by hil-bench-paper, the program that reproduces a paper.
int reproduce(const PaperArguments& paper, const Arguments& arguments) {
  std::vector<std::string> words{paper.paper};
  if (!arguments.out.empty()) words.insert(words.end(), {"--out", arguments.out});
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
  command.add_option("--out", arguments->out, "folder, or file.sqlite, of the results (default: here)");
  const auto threads =
      command.add_number("--threads", arguments->threads, "default: one a core", 1, most_threads);
  const auto shard =
      command.add_option("--shard", arguments->shard,
                         "i/N: only runs with run % N == i (default: the task of a Slurm array, or all)");
  command.add_number("--runs", arguments->runs, "another number of runs than the campaign's", 1,
                     campaign::most_runs);
  const auto resume = command.add_flag("--resume", arguments->resume, "continue with existing results");
  const auto target = command.add_option("--target", arguments->target,
                                         "program to fly against, with its arguments, as one word; over a "
                                         "bus in lockstep (default: the target's own "
                                         "code in process)");
  const auto unrounded =
      command.add_flag("--unrounded", arguments->unrounded,
                       "frames that round nothing: the difference is what the bus's resolution costs");
  const auto json = command.add_option(
      "--json", arguments->json, "write the report as JSON to a file; -: to stdout, in place of the text");
  const auto no_commands =
      command.add_flag("--no-commands", arguments->no_commands,
                       "refuse scenarios that execute something: commands, programs, FMUs");
  const auto live = add_live(command, arguments->live);
  auto paper = std::make_shared<PaperArguments>();
  const auto name =
      command.add_option("--paper", paper->paper,
                         "in place of FILE: what a paper claims, with a page of figures: " + papers::names());
  command.add_option("--exact", paper->exact, "with --paper: results without the bus's rounding, to compare")
      .needs(name);
  name.excludes(file);
  for (const auto& option : {shard, resume, threads, json, target, no_commands, live}) name.excludes(option);
  target.excludes(unrounded);
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
