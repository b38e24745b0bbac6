// A run's report for a terminal.
#pragma once

#include <string>

#include "bench/run/session.hpp"
#include "bench/scenario/scenario.hpp"

namespace canhil::report {

/// Verdict, checks, convergence, latency, losses: a page of text.
std::string text(const scenario::Scenario& scenario, const run::Run& run);

}  // namespace canhil::report
