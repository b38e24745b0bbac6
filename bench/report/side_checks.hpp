// Compares outcomes and numbers of checks between the runs of two sides.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace canhil::report {

struct ChecksCompared {
  bool worse = false;
  bool unknown = false;  ///< a check was not measured, or is missing, in one of the runs
  std::string text;      ///< one line for each check that changed or has numbers
};

/// Thrown by compare_checks() if a report contains an unknown outcome.
struct UnknownOutcome {
  std::string what;  ///< one line
};

/// What the runs of both sides have in common, and which difference counts.
struct CheckRule {
  bool lockstep = false;
  bool repeatable = false;  ///< FigureRule::repeatable
  double tolerance = 0;     ///< FigureRule::tolerance
  double largest_p = 0;     ///< of a single test; divided by the number of checks with numbers
};

/// A check got worse in three cases: it fails in a run of `after` but in no run of `before`; it fails in most
/// runs of `after` but not in most runs of `before`; or its margin got worse (compare_figures()). In
/// lockstep, timing is never judged, so a check that no run measured does not count as unknown.
ChecksCompared compare_checks(const std::vector<nlohmann::ordered_json>& before,
                              const std::vector<nlohmann::ordered_json>& after, const CheckRule& rule);

}  // namespace canhil::report
