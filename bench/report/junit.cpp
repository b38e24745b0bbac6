#include "bench/report/run_reports.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>

#include "bench/report/markup.hpp"
#include "bench/report/provenance.hpp"
#include "bench/report/summary.hpp"
#include "dbc/version/version.hpp"

namespace canhil::report {
namespace {

using checks::CheckResult;
using checks::Outcome;

std::string property(std::string_view name, std::string_view value) {
  return fmt::format("<property name=\"{}\" value=\"{}\"/>", name, escaped(value));
}

// The numbers of a check. A test case without a number has no property for it.
std::string numbers(const checks::Judgement& judgement) {
  std::string page;
  const auto& [criterion, measurement] = judgement;
  const auto add = [&](std::string_view name, const std::optional<double>& value) {
    if (value) page += property(name, fmt::format("{:.6g}", *value));
  };
  add("value", measurement.value);
  if (const std::string limit = to_text(criterion); !limit.empty()) page += property("limit", limit);
  if (!criterion.unit.empty()) page += property("unit", criterion.unit);
  add("margin", margin(judgement));
  if (measurement.worst_at_us) add("worst_at_s", static_cast<double>(*measurement.worst_at_us) / 1e6);
  return page;
}

// The path of the scenario as a package: bench.flights.los_quick.
std::string package_of(const std::string& file) {
  std::string package;
  for (const std::filesystem::path& part :
       std::filesystem::path(file).lexically_normal().replace_extension().relative_path()) {
    if (part != "..") package += (package.empty() ? "" : ".") + part.string();
  }
  return package;
}

}  // namespace

std::string junit_suite(std::string_view name, std::string_view package,
                        const std::vector<CheckResult>& cases, double wall_s, std::int64_t started_s,
                        const Properties& properties) {
  const auto count = [&](Outcome outcome) {
    return std::ranges::count(cases, outcome, &CheckResult::outcome);
  };
  std::string page =
      fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" skipped=\"{}\" time=\"{:.3f}\"{}>\n",
                  escaped(name), cases.size(), count(Outcome::fail), count(Outcome::not_measured), wall_s,
                  started_s == 0 ? "" : fmt::format(" timestamp=\"{}\"", date_utc(started_s)));
  if (!properties.empty()) {
    page += "    <properties>\n";
    for (const auto& [key, value] : properties) page += "      " + property(key, value) + "\n";
    page += "    </properties>\n";
  }
  for (const CheckResult& check : cases) {
    page += fmt::format("    <testcase classname=\"{}{}{}\" name=\"{}\">\n", escaped(package),
                        package.empty() ? "" : ".", escaped(check.kind), escaped(check.name));
    // Properties let a reader see a value approach its limit before the check fails.
    page += "      <properties>";
    if (!check.requirement.empty()) page += property("requirement", check.requirement);
    page += property("measured", check.measured) + property("expected", check.expected);
    page += numbers(check.judgement);
    page += "</properties>\n";
    const std::string message = escaped(fmt::format("{}; expected {}", check.measured, check.expected));
    if (check.outcome == Outcome::fail) page += fmt::format("      <failure message=\"{}\"/>\n", message);
    if (check.outcome == Outcome::not_measured)
      page += fmt::format("      <skipped message=\"not measured: {}\"/>\n", message);
    page += "    </testcase>\n";
  }
  return page + "  </testsuite>\n";
}

namespace {

// Operator, program and machine, as in the provenance of the JSON report.
Properties properties_of(const scenario::Scenario& scenario, const drive::Run& run) {
  Properties properties{{"version", std::string(version_text())}, {"revision", std::string(revision())}};
  if (!run.options.operator_name.empty()) properties.emplace_back("operator", run.options.operator_name);
  properties.emplace_back("host", host_name());
  properties.emplace_back("kernel", kernel());
  properties.emplace_back("cpu_model", cpu_model());
  properties.emplace_back("bus", run.options.bus.text);
  for (const scenario::Setting& one : scenario.settings) properties.emplace_back("set " + one.key, one.value);
  for (const drive::Adapter& adapter : run.adapters) properties.emplace_back("adapter", to_text(adapter));
  properties.emplace_back("target", target_program(run));
  if (!run.seen.target_version.empty()) properties.emplace_back("target_version", run.seen.target_version);
  for (const drive::RunFile& file : run.files)
    properties.emplace_back("sha256 of " + file.role, file.identity.sha256 + "  " + file.name);
  return properties;
}

// The whole run as a test case.
CheckResult completes(Outcome outcome, const std::string& measured) {
  return {.name = "run completes",
          .kind = "run",
          .requirement = "",
          .outcome = outcome,
          .measured = measured,
          .expected = "completed"};
}

}  // namespace

std::string junit_whole(std::string_view suites) {
  return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n{}</testsuites>\n", suites);
}

std::string junit(const scenario::Scenario& scenario, const drive::Run& run) {
  return junit_whole(junit_suite(scenario, run));
}

std::string junit_suite_not_run(const scenario::Scenario& scenario, const std::string& why) {
  return junit_suite(scenario.title, package_of(scenario.file), {completes(Outcome::fail, why)}, 0, 0);
}

std::string junit_suite(const scenario::Scenario& scenario, const drive::Run& run) {
  // The whole run is a test case too: a run that ended early fails even if no check does.
  std::vector<CheckResult> cases = run.verdict.checks;
  const bool early = run.ending.kind != drive::Ending::Kind::completed;
  const bool interrupted = run.ending.kind == drive::Ending::Kind::interrupted;
  cases.insert(cases.begin(), completes(interrupted ? Outcome::not_measured
                                        : early     ? Outcome::fail
                                                    : Outcome::pass,
                                        early ? run.ending.detail : "completed"));
  return junit_suite(scenario.title, package_of(scenario.file), cases, run.wall_s, run.started_s,
                     properties_of(scenario, run));
}

}  // namespace canhil::report
