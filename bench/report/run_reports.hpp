// A run's report in all its forms but the page, which is drawn from document().
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

/// As texts for a terminal name it: "PASS", "NOT MEASURED".
std::string label(checks::Outcome outcome);

/// For a terminal: verdict, checks, convergence, latency, losses: a page of text.
std::string text(const scenario::Scenario& scenario, const drive::Run& run);

/// For CI servers, JUnit XML: one test case a check; not measured is 'skipped' with the reason; what was
/// measured, what was expected and requirement ids are properties. The suite's time stamp is the start of the
/// run (UTC).
std::string junit(const scenario::Scenario& scenario, const drive::Run& run);
/// Of a suite as a whole: name and value.
using Properties = std::vector<std::pair<std::string, std::string>>;
/// One test suite of such a file, a case a check, and the file around suites. `started_s`: 0: not known.
std::string junit_suite(std::string_view name, const std::vector<checks::CheckResult>& cases, double wall_s,
                        std::int64_t started_s, const Properties& properties = {});
std::string junit_whole(std::string_view suites);

/// A table that anybody can read, a line an answer and quantity. Comma-separated: t_s (time of validity),
/// estimator, quantity, unit, estimate, truth, error, sigma, in SI and rad. Empty fields were not told. A
/// statistic or an innovation is in `estimate`. The order is that of estimators, of their quantities, of
/// time. Given part by part.
void csv(const scenario::Scenario& scenario, const drive::Run& run, const Sink& give);

/// The value of "schema" in a report.
inline constexpr std::string_view schema = "canhil-report-1";

/// For programs, one JSON object: verdict, checks, figures, provenance, and all that the page shows. Times in
/// s, angles in rad, unit in every key; docs/report.md describes it.
nlohmann::ordered_json document(const scenario::Scenario& scenario, const drive::Run& run);

/// The same as text: an object a line for each key, an array of numbers on one line.
std::string json(const scenario::Scenario& scenario, const drive::Run& run);

}  // namespace canhil::report
