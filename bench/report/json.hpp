// A run's report for programs.
#pragma once

#include <string>

#include "bench/run/session.hpp"
#include "bench/scenario/scenario.hpp"

namespace canhil::report {

/// One JSON object: verdict, checks, figures, provenance. Times in s, angles in rad, unit in every key.
std::string json(const scenario::Scenario& scenario, const run::Run& run);

}  // namespace canhil::report
