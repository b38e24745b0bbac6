#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bench/campaign/execute.hpp"
#include "bench/commands/campaign.hpp"
#include "bench/commands/exit_code.hpp"
#include "bench/commands/interrupt.hpp"
#include "bench/commands/live.hpp"
#include "bench/commands/progress_line.hpp"
#include "bench/drive/inputs.hpp"
#include "bench/drive/target_command.hpp"
#include "bench/fault_matrix/execute.hpp"
#include "bench/fault_matrix/report.hpp"
#include "bench/report/file.hpp"
#include "bench/report/signature.hpp"
#include "dbc/files/command_files.hpp"

namespace canhil::commands {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_threads = 1024, most_runs = 100'000;

// The arguments as given on the command line.
struct Shown {
  std::string json, html;
  bool markdown = false;
};
struct Arguments {
  std::vector<std::string> scenarios;
  std::string set;
  std::optional<std::uint64_t> seed, runs, threads;
  std::string out, shard, target;
  bool resume = false;
  Shown shown;
  Live live;
};
struct MergeArguments {
  std::vector<std::string> files;
  Shown shown;
};

void add_shown(command_line::Command command, Shown& shown) {
  command.add_option("--json", shown.json, "also as JSON, to a file; -: to stdout, in place of the text");
  command.add_option("--html", shown.html, "also as one HTML page, to a file");
  command.add_flag("--markdown", shown.markdown, "as a table of Markdown, in place of the text");
}

void declare(const Shown& shown, CommandFiles& files) {
  files.writes("--json", shown.json);
  files.writes_file("--html", shown.html);
}

Result<void> check_files(const Arguments& arguments, const fault_matrix::Plan& plan,
                         const fs::path& results) {
  CommandFiles files;
  for (const fault_matrix::Column& column : plan.columns) files.reads(drive::inputs_of(column.scenario));
  files.reads("--set", arguments.set);
  files.reads(drive::inputs_of_target(arguments.target));
  files.may_write("results", results.string());
  for (std::size_t cell = 0; cell < plan.cells.size(); ++cell) {
    for (const fs::path& file : fault_matrix::files_of_violation(arguments.out, cell))
      files.may_write("scenario or log of a violation", file.string());
  }
  declare(arguments.shown, files);
  if (auto distinct = files.check_distinct(); !distinct) return distinct;
  std::error_code error;  // creates the folder first, because the output files may be in it
  if (!arguments.out.empty()) fs::create_directories(arguments.out, error);
  if (error) return failure(fmt::format("{}: cannot be a folder: {}", arguments.out, error.message()));
  return files.check_writable();
}

ExitCode show(const fault_matrix::Results& results, const Shown& shown, const std::string& folder) {
  if (shown.json != report::to_stdout) {
    const auto text = shown.markdown ? fault_matrix::markdown(results) : fault_matrix::text(results, folder);
    if (auto written = report::show(text); !written) return complain(written.error());
  }
  if (!shown.json.empty()) {
    if (auto written = report::write(shown.json, fault_matrix::json(results)); !written)
      return complain(written.error());
  }
  if (!shown.html.empty()) {
    if (auto written = report::write_file(shown.html, fault_matrix::html(results, folder)); !written)
      return complain(written.error());
  }
  return exit_code(fault_matrix::outcome_of(results));
}

Result<fault_matrix::Plan> plan_of(const Arguments& arguments) {
  std::vector<fault_matrix::Column> columns;
  for (const std::string& file : arguments.scenarios) {
    auto column = fault_matrix::read_column(file);
    if (!column) return tl::unexpected(column.error());
    columns.push_back(std::move(*column));
  }
  const std::uint64_t seed = arguments.seed.value_or(1), runs = arguments.runs.value_or(1);
  if (arguments.set.empty()) return fault_matrix::made_plan(std::move(columns), seed, runs);
  return fault_matrix::plan_of(std::move(columns), arguments.set, seed, runs);
}

ExitCode execute(const Arguments& arguments) {
  const auto shard =
      arguments.shard.empty() ? campaign::shard_of_environment() : campaign::parse_shard(arguments.shard);
  if (!shard) return complain(shard.error());
  if (!arguments.target.empty()) {
    if (auto fine = drive::check_target(arguments.target); !fine) return complain(fine.error());
  }
  if (auto distinct = check_distinct_inputs(arguments.scenarios); !distinct)
    return complain(distinct.error());
  const auto plan = plan_of(arguments);
  if (!plan) return complain(plan.error());
  const fs::path folder = arguments.out;
  const fs::path file =
      folder / (shard->count == 1 ? std::string("faults.jsonl")
                                  : fmt::format("faults-{}-of-{}.jsonl", shard->index, shard->count));
  if (auto fine = check_files(arguments, *plan, file); !fine) return complain(fine.error());

  live::Batch batch{.title = fmt::format("Faults: {}", fmt::join(arguments.scenarios, ", ")),
                    .of = "flights",
                    .failed_means = "violations"};
  auto view = OpenView::open(arguments.live, {.batch = batch});
  if (!view) return complain(view.error());
  catch_interrupts();  // from here on, the results file is being written
  const auto identity = fault_matrix::identity_of(*plan, arguments.target);
  auto opened = fault_matrix::Writer::open(file, identity, arguments.resume);
  if (!opened) return complain(opened.error());
  fault_matrix::Writer& writer = opened->first;
  fault_matrix::Results& results = opened->second;
  std::set<std::size_t> cells;
  for (std::size_t cell = shard->index; cell < plan->cells.size(); cell += shard->count) {
    if (!results.cells.contains(cell)) cells.insert(cell);
  }
  std::size_t done = 0;
  batch.total = cells.size();
  const auto start = std::chrono::steady_clock::now();
  const auto show_live = [&](const fault_matrix::Finished& finished) {
    if (view->get() == nullptr) return;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    const bool violated = finished.response.kind == fault_matrix::Response::Kind::violated;
    batch.done = done;
    batch.failed += violated ? 1 : 0;
    batch.rate_per_s = static_cast<double>(done) / elapsed.count();
    batch.add({.name = fmt::format("{} · {}", plan->rows[finished.row].name(),
                                   plan->columns[finished.column].scenario.title),
               .result = fault_matrix::to_text(finished.response),
               .failed = violated});
    view->get()->show(batch);
  };
  const auto end_live = [&](ExitCode code, std::string reason) {
    if (view->get() == nullptr) return code;
    batch.outcome = outcome_of(code);
    batch.reason = std::move(reason);
    view->get()->show(batch);
    view->hold();
    return code;
  };
  const auto flown = [&] {
    const ProgressLine line;
    return fault_matrix::execute(*plan, cells,
                                 {.target = arguments.target,
                                  .folder = folder,
                                  .threads = static_cast<unsigned>(arguments.threads.value_or(0)),
                                  .finished = [&](fault_matrix::Finished finished) -> Result<void> {
                                    if (auto added = writer.add(finished); !added) return added;
                                    ++done;
                                    show_live(finished);
                                    line.show([&] {
                                      const auto of = static_cast<double>(cells.size());
                                      return fmt::format("{} {} / {} flights",
                                                         progress_bar(static_cast<double>(done) / of), done,
                                                         cells.size());
                                    });
                                    results.cells.insert_or_assign(finished.cell, std::move(finished));
                                    return {};
                                  }},
                                 interrupted);
  }();
  if (!flown) {
    if (view->get() != nullptr) view->get()->show_ended(flown.error().message);
    return end_with(flown.error());
  }
  if (done < cells.size()) {
    return end_live(end_interrupted(fmt::format("; --resume goes on with {}", file.string())), "interrupted");
  }
  if (arguments.resume) say(report::signature_line(file.string()));
  if (shard->count == 1) return end_live(show(results, arguments.shown, folder.string()), "");
  const bool violated = std::ranges::any_of(results.cells, [](const auto& cell) {
    return cell.second.response.kind == fault_matrix::Response::Kind::violated;
  });
  return end_live(violated ? ExitCode::fail : ExitCode::pass, "the shard is flown");
}

ExitCode merge(const MergeArguments& arguments) {
  const std::vector<fs::path> files(arguments.files.begin(), arguments.files.end());
  if (auto distinct = check_distinct_inputs(arguments.files); !distinct) return complain(distinct.error());
  CommandFiles named;
  for (const std::string& file : arguments.files) named.reads("RESULTS", file);
  declare(arguments.shown, named);
  if (auto fine = named.check(); !fine) return complain(fine.error());
  const auto results = fault_matrix::merged(files);
  if (!results) return complain(results.error());
  for (const std::string& file : arguments.files) say(report::signature_line(file));
  return show(*results, arguments.shown, files.front().parent_path().string());
}

}  // namespace

void add_faults(command_line::Command app, int& code) {
  auto arguments = std::make_shared<Arguments>();
  const auto command = app.add_subcommand(std::string(faults_name), std::string(faults_summary));
  const auto scenarios = command.add_option("SCENARIO", arguments->scenarios, "scenario files (TOML)");
  command.add_option("--set", arguments->set,
                     "file of [[fault]] tables, each a row; those with the same 'together' fly at once "
                     "(default: each kind on each node, at times drawn from the seed)");
  command.add_number("--seed", arguments->seed, "of what is drawn (default: 1)");
  command.add_number("--runs", arguments->runs, "flights a cell, each with another seed (default: 1)", 1,
                     most_runs);
  command.add_option("--out", arguments->out,
                     "folder of the results and of the scenarios that show violations (default: here)");
  command.add_number("--threads", arguments->threads, "default: one a core", 1, most_threads);
  command.add_option(
      "--shard", arguments->shard,
      "i/N: only each N-th flight from the i-th on (default: the task of a Slurm array, or all)");
  command.add_flag("--resume", arguments->resume, "continue with existing results");
  command.add_option("--target", arguments->target,
                     "program to fly against, with its arguments, as one word; in lockstep (default: the "
                     "target's own code in process)");
  add_shown(command, arguments->shown);
  add_live(command, arguments->live);
  command.require_subcommands(0, 1);
  auto merging = std::make_shared<MergeArguments>();
  const auto merge_command = command.add_subcommand("merge", "the matrix of shards put together");
  merge_command.add_option("RESULTS", merging->files, "results of the shards").required();
  add_shown(merge_command, merging->shown);
  merge_command.on_given([&code, merging] { code = static_cast<int>(merge(*merging)); });
  command.on_given([&code, arguments, command, scenarios] {
    if (command.subcommand_given()) return;
    if (!scenarios.given()) command_line::throw_required("SCENARIO, or merge");
    code = static_cast<int>(execute(*arguments));
  });
}

}  // namespace canhil::commands
