#include "bench/commands/campaign_flight.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <vector>

#include "bench/campaign/evaluate.hpp"
#include "bench/campaign/execute.hpp"
#include "bench/campaign/matrix/flights.hpp"
#include "bench/campaign/shards.hpp"
#include "bench/campaign_report/matrix.hpp"
#include "bench/campaign_report/report.hpp"
#include "bench/commands/campaign.hpp"
#include "bench/commands/campaign_course.hpp"
#include "bench/commands/interrupt.hpp"
#include "bench/commands/progress_line.hpp"
#include "bench/drive/inputs.hpp"
#include "bench/drive/target_command.hpp"
#include "bench/report/file.hpp"
#include "bench/report/signature.hpp"

namespace canhil::commands {
namespace {

namespace fs = std::filesystem;

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

// --out names the results file (*.sqlite) or a folder for it.
Result<fs::path> results_file(const std::string& folder, const std::string& stem,
                              const campaign::Shard& shard) {
  const fs::path out = folder;
  if (out == report::to_stdout) return failure("--out -: expected a folder or a file, not standard output");
  if (out.extension() == ".sqlite") return out;
  return out / (shard.count == 1 ? stem + ".sqlite"
                                 : fmt::format("{}-{}-of-{}.sqlite", stem, shard.index, shard.count));
}

Result<void> make_folder(const fs::path& out) {
  std::error_code error;
  if (!out.empty() && out.extension() != ".sqlite") fs::create_directories(out, error);
  if (error) return failure(fmt::format("{}: cannot be a folder: {}", out.string(), error.message()));
  return {};
}

Result<void> check_files(const campaign::Campaign& campaign, const CampaignFlight& flight,
                         const fs::path& results) {
  CommandFiles files;
  files.reads(campaign::inputs_of(campaign));
  files.reads(drive::inputs_of_target(flight.target));
  files.may_write("--out", results.string());
  if (campaign.matrix) {
    constexpr std::uint64_t most_looked_at = 100'000;
    const std::uint64_t flights = std::min(campaign.variants.size() * campaign.runs, most_looked_at);
    for (std::size_t number = 0; number < flights; ++number) {
      for (const fs::path& file : campaign::matrix::files_of_violation(results.parent_path(), number))
        files.may_write("scenario or log of a violation", file.string());
    }
  }
  declare(flight.reports, files);
  if (auto distinct = files.check_distinct(); !distinct) return distinct;
  if (auto made = make_folder(flight.out); !made) return made;
  return files.check_writable();
}

ExitCode show(const campaign::Reported& all, const CampaignReports& reports) {
  Result<void> written;
  const auto note = [&](Result<void> one) {
    if (written && !one) written = std::move(one);
  };
  if (reports.json != report::to_stdout && reports.junit != report::to_stdout)
    note(report::show(reports.markdown ? campaign::matrix_markdown(all.campaign, all.evaluation)
                                       : campaign::text(all)));
  if (!reports.json.empty()) note(report::write(reports.json, campaign::json(all)));
  if (!reports.junit.empty()) note(report::write(reports.junit, campaign::junit(all)));
  if (!reports.html.empty()) note(report::write_file(reports.html, campaign::page(all)));
  if (!reports.csv.empty()) note(report::write_file(reports.csv, campaign::csv(all)));
  if (!written) return complain(written.error());
  if (const std::string why = all.evaluation.not_judged(); !why.empty())
    complain({fmt::format("{}: {}", all.campaign.sources.file, why)});
  return exit_code(all.evaluation.outcome());
}

ExitCode report_on_file(const campaign::Campaign& campaign, const fs::path& file,
                        const CampaignReports& reports) {
  const auto store = campaign::Store::open(file);
  if (!store) return complain(store.error());
  const auto evaluation = campaign::evaluate(campaign, *store);
  if (!evaluation) return complain(evaluation.error());
  return show({.campaign = campaign, .evaluation = *evaluation, .folder = file.parent_path()}, reports);
}

Result<void> check_report(const CampaignReports& reports, const campaign::Campaign& campaign,
                          const campaign::Shard& shard) {
  if (reports.markdown && !campaign.matrix)
    return failure("--markdown: is for a matrix of faults, expected [faults] in the campaign");
  if (shard.count == 1) return {};
  for (const auto& [option, file] : {std::pair("--json", &reports.json), std::pair("--junit", &reports.junit),
                                     std::pair("--html", &reports.html), std::pair("--csv", &reports.csv)}) {
    if (!file->empty())
      return failure(fmt::format("{}: a shard has no report, expected all runs: merge them first", option));
  }
  return {};
}

}  // namespace

std::vector<command_line::Option> add_reports(command_line::Command command, CampaignReports& reports) {
  return {command.add_option("--json", reports.json,
                             "write the report as JSON to a file; -: to stdout, in place of the text"),
          command.add_option("--junit", reports.junit,
                             "write the answers as JUnit XML to a file; -: to stdout, in place of the text"),
          command.add_option("--html", reports.html, "write the report as one HTML page to a file"),
          command.add_option("--csv", reports.csv, "write a table of the answers to a file"),
          command.add_flag("--markdown", reports.markdown,
                           "print the matrix of faults as tables of Markdown, in place of the text")};
}

void declare(const CampaignReports& reports, CommandFiles& files) {
  files.writes("--json", reports.json);
  files.writes("--junit", reports.junit);
  files.writes_file("--html", reports.html);
  files.writes_file("--csv", reports.csv);
}

FlightOptions add_flight(command_line::Command command, CampaignFlight& flight) {
  command.add_option("--out", flight.out,
                     "folder, or file.sqlite, of the results; scenarios that show violations come beside it "
                     "(default: here)");
  const auto threads =
      command.add_number("--threads", flight.threads, "default: one a core", 1, most_threads);
  const auto shard =
      command.add_option("--shard", flight.shard,
                         "i/N: only each N-th run from the i-th on (default: the task of a Slurm array, or "
                         "all)");
  const auto resume = command.add_flag("--resume", flight.resume, "continue with existing results");
  const auto target =
      command.add_option("--target", flight.target,
                         "program to fly against, with its arguments, as one word; over a bus in lockstep "
                         "(default: the target's own code in process)");
  FlightOptions options{.target = target, .own = add_reports(command, flight.reports)};
  options.own.insert(options.own.end(), {threads, shard, resume, target, add_live(command, flight.live)});
  return options;
}

ExitCode fly(const campaign::Campaign& campaign, const CampaignFlight& flight, const std::string& stem) {
  const auto shard =
      flight.shard.empty() ? campaign::shard_of_environment() : campaign::parse_shard(flight.shard);
  if (!shard) return complain(shard.error());
  if (!flight.target.empty()) {
    if (auto fine = drive::check_target(flight.target); !fine) return complain(fine.error());
  }
  const auto file = results_file(flight.out, stem, *shard);
  if (!file) return complain(file.error());
  if (auto fine = check_report(flight.reports, campaign, *shard); !fine) return complain(fine.error());
  if (auto fine = check_files(campaign, flight, *file); !fine) return complain(fine.error());

  auto view = OpenView::open(flight.live, {.batch = Course::begun(campaign)});
  if (!view) return complain(view.error());
  std::optional<Course> course;
  if (view->get() != nullptr) course.emplace(campaign, *view->get());
  catch_interrupts();
  const auto execution = [&] {
    const ProgressLine line;
    const auto start = std::chrono::steady_clock::now();
    const auto show_progress = [&](const campaign::Progress& progress) {
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
      if (course) course->progress(progress, elapsed.count());
      if (progress.total > 0) line.show([&] { return progress_text(progress, elapsed.count()); });
    };
    return campaign::execute(campaign,
                             {.file = *file,
                              .shard = *shard,
                              .threads = static_cast<unsigned>(flight.threads.value_or(0)),
                              .resume = flight.resume,
                              .target = flight.target,
                              .committed =
                                  [&](std::span<const campaign::Finished> runs) {
                                    if (course) course->committed(runs);
                                  },
                              .progress = show_progress},
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
  if (campaign.matrix && flight.resume) say(report::signature_line(file->string()));
  const ExitCode code = shard->count > 1 ? ExitCode::pass : report_on_file(campaign, *file, flight.reports);
  if (course) course->end(outcome_of(code), shard->count > 1 ? "the shard is flown" : "");
  view->hold();
  return code;
}

ExitCode report_on(const std::vector<std::string>& files, const CampaignReports& reports) {
  if (auto distinct = check_distinct_inputs(files); !distinct) return complain(distinct.error());
  CommandFiles named;
  for (const std::string& file : files) named.reads("RESULTS", file);
  declare(reports, named);
  if (auto fine = named.check(); !fine) return complain(fine.error());
  const std::vector<fs::path> paths(files.begin(), files.end());
  const auto shards = campaign::Shards::open(paths);
  if (!shards) return complain(shards.error());
  const campaign::Campaign& campaign = shards->campaign();
  if (auto fine = check_report(reports, campaign, {}); !fine) return complain(fine.error());
  auto evaluation = campaign::evaluate(campaign, [&](std::size_t variant) { return shards->load(variant); });
  if (!evaluation) return complain(evaluation.error());
  evaluation->identity = shards->first().identity();
  const ExitCode code =
      show({.campaign = campaign, .evaluation = *evaluation, .folder = paths.front().parent_path()}, reports);
  if (code == ExitCode::usage) return code;
  for (const std::string& file : files) say(report::signature_line(file));
  return code;
}

}  // namespace canhil::commands
