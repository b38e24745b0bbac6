// How the checks of a scenario developed over many runs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/checks/verdict.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::report {

/// A report of a run and the file that contains it.
struct Kept {
  std::string file;
  nlohmann::ordered_json report;
};

struct History {
  /// Fail: the newest run of a scenario has a check that fails, or whose margin is smaller than the median of
  /// the runs before it by more than the tolerance. Not measured: no scenario has two runs.
  checks::Outcome outcome = checks::Outcome::not_measured;
  std::string text;  ///< for each scenario its runs, and a line for each check with numbers
  std::string page;  ///< HTML, with a picture of the margins of each scenario
};

/// The history of these reports, made by document(): by scenario, in order of their dates. `tolerance`: see
/// usual_tolerance. An error is one line of text: what a report lacks.
Result<History> history(std::vector<Kept> reports, double tolerance);

}  // namespace canhil::report
