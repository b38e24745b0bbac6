// Compares the outcomes of checks between the runs of two sides.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace canhil::report {

struct ChecksCompared {
  bool worse = false;
  bool unknown = false;  ///< a check was not measured, or is missing, in one of the runs
  std::string text;      ///< one line for each check that changed
};

/// Thrown by compare_checks() if a report contains an unknown outcome.
struct UnknownOutcome {
  std::string what;  ///< one line
};

/// A check got worse in two cases: it fails in a run of `after` but in no run of `before`, or it fails in
/// most runs of `after` but not in most runs of `before`. In lockstep, timing is never judged, so a check
/// that no run measured does not count as unknown.
ChecksCompared compare_checks(const std::vector<nlohmann::ordered_json>& before,
                              const std::vector<nlohmann::ordered_json>& after, bool lockstep);

}  // namespace canhil::report
