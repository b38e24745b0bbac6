// A run's report in all formats except the page, which is drawn from document().
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/drive/session.hpp"
#include "bench/report/file.hpp"
#include "bench/scenario/scenario.hpp"

namespace canhil::report {

/// The outcome as shown on a terminal: "PASS", "NOT MEASURED".
std::string label(std::string_view outcome);

/// The report for a terminal, a page of text: verdict, checks, convergence, latency, losses.
std::string text(const scenario::Scenario& scenario, const drive::Run& run);

/// The report for CI servers, JUnit XML: one test case for each check. A check that was not measured is
/// reported as 'skipped', with the reason. The properties of a test case contain the measured value, the
/// expected value and the id of the requirement, and, where the check has numbers, `value`, `limit`, `unit`,
/// `margin` and `worst_at_s`, as in the JSON. The time stamp of the suite is the start of the run (UTC).
std::string junit(const scenario::Scenario& scenario, const drive::Run& run);
/// The test suite of a run, for a JUnit file of several runs.
std::string junit_suite(const scenario::Scenario& scenario, const drive::Run& run);
/// The test suite of a run that did not begin; `why`: the error.
std::string junit_suite_not_run(const scenario::Scenario& scenario, const std::string& why);
/// Properties of a whole suite: name and value.
using Properties = std::vector<std::pair<std::string, std::string>>;
/// A test suite for a JUnit file, with a test case for each check. `package`: what the test cases belong to,
/// such as the scenario; a class name is the package and the kind of check, because a CI server joins the
/// files of a pipeline and knows a test case by class name and name. `started_s`: start of the run; 0:
/// unknown.
std::string junit_suite(std::string_view name, std::string_view package,
                        const std::vector<checks::CheckResult>& cases, double wall_s, std::int64_t started_s,
                        const Properties& properties = {});
/// The JUnit file that contains the suites.
std::string junit_whole(std::string_view suites);

/// A CSV table with a line for each answer and quantity: t_s (time of validity), estimator, quantity, unit,
/// estimate, truth, error, sigma, in SI and rad. A field is empty if the value was not reported. The column
/// `estimate` also holds statistics and innovations. Lines are sorted by estimator, quantity and time. `give`
/// receives the table part by part.
void csv(const scenario::Scenario& scenario, const drive::Run& run, const Sink& give);

/// The value of "schema" in a report.
inline constexpr std::string_view schema = "canhil-report-1";

/// The report for programs, a JSON object: verdict, checks, figures, provenance, and all data of the page.
/// Times are in s, angles in rad; every key contains the unit. docs/report.md describes this object.
nlohmann::ordered_json document(const scenario::Scenario& scenario, const drive::Run& run);

/// The text of document(): one line for each key of an object, and one for each array of numbers.
std::string json(const scenario::Scenario& scenario, const drive::Run& run);

}  // namespace canhil::report
