// A run's report for CI servers.
#pragma once

#include <string>

#include "bench/drive/session.hpp"
#include "bench/scenario/scenario.hpp"

namespace canhil::report {

/// JUnit XML: one test case a check; not measured is 'skipped' with the reason; what was measured, what was
/// expected and requirement ids are properties. The suite's time stamp is the start of the run (UTC).
std::string junit(const scenario::Scenario& scenario, const drive::Run& run);

}  // namespace canhil::report
