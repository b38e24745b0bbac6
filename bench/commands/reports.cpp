#include "bench/commands/reports.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/drive/kept_frames.hpp"
#include "bench/report/file.hpp"
#include "bench/report/page.hpp"
#include "bench/report/run_reports.hpp"

namespace canhil::commands {

void add_reports(command_line::Command command, Reports& reports) {
  command.add_option("--json", reports.json,
                     "write the report as JSON to a file; -: to stdout, in place of the text");
  command.add_option("--junit", reports.junit,
                     "write the checks as JUnit XML to a file; -: to stdout, in place of the text");
  command.add_option("--html", reports.html, "write the report as one HTML page to a file");
  command.add_option("--csv", reports.csv,
                     "write a table of time, quantity, estimate, truth, error and sigma to a file");
}

void declare(const Reports& reports, CommandFiles& files) {
  files.writes("--json", reports.json);
  files.writes("--junit", reports.junit);
  files.writes_file("--html", reports.html);
  files.writes_file("--csv", reports.csv);
}

void remove_earlier(const Reports& reports) {
  for (const std::string& path : {reports.json, reports.junit, reports.html, reports.csv}) {
    std::error_code ignored;
    if (path != report::to_stdout) std::filesystem::remove(path, ignored);
  }
}

std::shared_ptr<drive::KeptFrames> frames_for(const Reports& reports) {
  return reports.html.empty() ? nullptr : std::make_shared<drive::KeptFrames>();
}

Result<void> write_reports(const Reports& reports, const scenario::Scenario& scenario,
                           const drive::Run& run) {
  Result<void> all;
  const auto note = [&](Result<void> written) {
    if (all && !written) all = std::move(written);
  };
  if (reports.json != report::to_stdout && reports.junit != report::to_stdout) {
    note(report::show(report::text(scenario, run)));
  }
  if (!reports.json.empty()) note(report::write(reports.json, report::json(scenario, run)));
  if (!reports.junit.empty()) note(report::write(reports.junit, report::junit(scenario, run)));
  if (!reports.html.empty()) {
    const auto page = report::html(report::document(scenario, run));
    note(page ? report::write_file(reports.html, *page) : tl::unexpected(page.error()));
  }
  if (!reports.csv.empty()) {
    note(
        report::write_file(reports.csv, [&](const report::Sink& give) { report::csv(scenario, run, give); }));
  }
  if (run.log_error) note(tl::unexpected(*run.log_error));
  return all;
}

}  // namespace canhil::commands
