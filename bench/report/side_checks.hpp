// The outcomes of the checks, from the runs of one side to those of another.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace canhil::report {

struct ChecksCompared {
  bool worse = false;
  bool unknown = false;  ///< a check was not measured, or is missing, in one of the runs
  std::string text;      ///< a line for each check that changed
};

/// A report with an outcome that is none. Thrown by compare_checks().
struct UnknownOutcome {
  std::string what;  ///< one line
};

/// A check got worse if it fails in a run and did in none before, or in most and did not in most before. In
/// virtual time, where timing is never judged, a check that no run measured is not unknown.
ChecksCompared compare_checks(const std::vector<nlohmann::ordered_json>& before,
                              const std::vector<nlohmann::ordered_json>& after, bool virtual_time);

}  // namespace canhil::report
