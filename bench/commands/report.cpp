#include "bench/commands/subcommands.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/commands/exit_code.hpp"
#include "bench/report/compare.hpp"
#include "bench/report/file.hpp"
#include "bench/report/history.hpp"
#include "bench/report/page.hpp"
#include "bench/report/signature.hpp"
#include "dbc/files/command_files.hpp"

namespace canhil::commands {
namespace {

// The path of the HTML page of a report: the page is written beside the report.
std::string page_path(const std::string& report) {
  return std::filesystem::path(report).replace_extension(".html").string();
}

// Checks that the page can be written beside the report. Rejects a report that is a pipe or a device, because
// the page would be written into the same folder, for example /dev.
Result<void> has_room_for_a_page(const std::string& path) {
  std::error_code unknown;
  const auto status = std::filesystem::status(path, unknown);
  if (std::filesystem::is_other(status))
    return failure(fmt::format(
        "file '{}': is not a regular file, expected one, as its page is to stand beside it", path));
  return check_writable(page_path(path));
}

Result<void> rebuild(const std::string& path) {
  auto document = report::read_document(path);
  if (!document) return tl::unexpected(document.error());
  if (auto room = has_room_for_a_page(path); !room) return room;
  auto page = report::html(*document);
  if (!page) return failure(fmt::format("file '{}': {}", path, page.error().message));
  return report::write_file(page_path(path), *page);
}

ExitCode rebuild_all(const std::vector<std::string>& paths) {
  CommandFiles files;
  for (const std::string& path : paths) {
    files.reads("report", path);
    files.may_write("page", page_path(path));
  }
  if (auto distinct = files.check_distinct(); !distinct) return complain(distinct.error());
  for (const std::string& path : paths) {
    if (auto built = rebuild(path); !built) return complain(built.error());
    fmt::print("{}\n", one_line(page_path(path)));
    say(report::signature_line(path));
  }
  return ExitCode::pass;
}

// The arguments as given on the command line.
struct Sides {
  std::string a, b;
  std::vector<std::string> before, after;
  double tolerance_percent = 100 * report::usual_tolerance;
  std::string history, html;
};

Result<report::Reports> read_all(const std::vector<std::string>& paths) {
  report::Reports reports;
  for (const std::string& path : paths) {
    auto report = report::read_document(path);
    if (!report) return tl::unexpected(report.error());
    reports.push_back(std::move(*report));
  }
  return reports;
}

// The reports of runs in a folder; other files are left out.
Result<std::vector<report::Kept>> reports_in(const std::string& folder) {
  std::vector<report::Kept> reports;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() != ".json") continue;
    auto report = report::read_document(entry.path().string());
    if (!report) return tl::unexpected(report.error());
    reports.push_back({.file = entry.path().string(), .report = std::move(*report)});
  }
  if (error) return failure(fmt::format("--history '{}': {}, expected a folder", folder, error.message()));
  if (reports.empty())
    return failure(
        fmt::format("--history '{}': has no report, expected files of hil-bench run --json", folder));
  return reports;
}

ExitCode tell_history(const Sides& arguments) {
  auto reports = reports_in(arguments.history);
  if (!reports) return complain(reports.error());
  CommandFiles files;
  for (const report::Kept& one : *reports) files.reads("report", one.file);
  files.writes_file("--html", arguments.html);
  if (auto fine = files.check(); !fine) return complain(fine.error());
  const auto told = report::history(std::move(*reports), arguments.tolerance_percent / 100);
  if (!told) return complain(told.error());
  if (auto shown = report::show(told->text); !shown) return complain(shown.error());
  if (!arguments.html.empty()) {
    if (auto written = report::write_file(arguments.html, told->page); !written)
      return complain(written.error());
  }
  return exit_code(told->outcome);
}

ExitCode compare_sides(Sides sides) {
  if (!sides.history.empty()) {
    if (!sides.a.empty() || !sides.before.empty() || !sides.after.empty())
      return complain({"--history: excludes reports to compare, expected one of the two"});
    return tell_history(sides);
  }
  if (!sides.html.empty()) return complain({"--html: is the page of a history, expected --history FOLDER"});
  const bool two = !sides.a.empty() && !sides.b.empty();
  const bool several = !sides.before.empty() && !sides.after.empty();
  const bool any_option = !sides.before.empty() || !sides.after.empty();
  if (!(two && !any_option) && !(several && sides.a.empty()))
    return complain(
        {"compare: expected A.json B.json, or --before A.json... --after B.json..., or --history FOLDER"});
  if (two) {
    sides.before = {sides.a};
    sides.after = {sides.b};
  }
  // Rejects a run that is given twice, because it would make the scatter between runs look smaller.
  for (const auto* side : {&sides.before, &sides.after}) {
    if (auto distinct = check_distinct_inputs(*side); !distinct) return complain(distinct.error());
  }
  const auto before = read_all(sides.before);
  if (!before) return complain(before.error());
  const auto after = read_all(sides.after);
  if (!after) return complain(after.error());
  const auto compared = report::compare(*before, *after, sides.tolerance_percent / 100);
  if (!compared) return complain(compared.error());
  if (auto shown = report::show(compared->text); !shown) return complain(shown.error());
  return compared->outcome == report::Comparison::no_worse ? ExitCode::pass
         : compared->outcome == report::Comparison::worse  ? ExitCode::fail
                                                           : ExitCode::not_measured;
}

}  // namespace

void add_report(command_line::Command app, int& code) {
  auto paths = std::make_shared<std::vector<std::string>>();
  const auto rebuild = app.add_subcommand("report", "make the HTML pages of reports again from their JSON");
  rebuild.add_option("FILE.json", *paths, "reports of hil-bench run --json; FILE.html is written beside each")
      .required();
  rebuild.on_given([&code, paths] { code = static_cast<int>(rebuild_all(*paths)); });

  auto sides = std::make_shared<Sides>();
  const auto compare = app.add_subcommand(
      "compare",
      "say what got worse from some runs to others of the same scenario: 0 nothing, 1 something, 3 not "
      "comparable");
  compare.add_option("A.json", sides->a, "the report to compare with");
  compare.add_option("B.json", sides->b, "the report that is judged");
  compare.add_option("--before", sides->before, "several runs to compare with, in place of A.json");
  compare.add_option("--after", sides->after, "the runs that are judged, in place of B.json");
  compare.add_number(
      "--tolerance", sides->tolerance_percent,
      "largest loss of a check's margin that is not worse, in percent of the limit; default 10", 0, 1000);
  compare.add_option(
      "--history", sides->history,
      "folder of reports: how the checks of each scenario developed, and whether the newest run is "
      "worse than those before");
  compare.add_option("--html", sides->html, "with --history: also as one HTML page, to a file");
  compare.on_given([&code, sides] { code = static_cast<int>(compare_sides(*sides)); });
}

}  // namespace canhil::commands
