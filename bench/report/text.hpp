// A run's report for a terminal.
#pragma once

#include <string>

#include "bench/drive/session.hpp"
#include "bench/scenario/scenario.hpp"

namespace canhil::report {

/// Verdict, checks, convergence, latency, losses: a page of text.
std::string text(const scenario::Scenario& scenario, const drive::Run& run);

}  // namespace canhil::report
