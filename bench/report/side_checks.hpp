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

/// A report contains an unknown outcome. Thrown by compare_checks().
struct UnknownOutcome {
  std::string what;  ///< one line
};

/// A check got worse if it fails in a run of `after` and in none of `before`, or in most runs of `after` and
/// not in most of `before`. In lockstep, timing is never judged, so a check that no run measured does not
/// count as unknown.
ChecksCompared compare_checks(const std::vector<nlohmann::ordered_json>& before,
                              const std::vector<nlohmann::ordered_json>& after, bool lockstep);

}  // namespace canhil::report
