// Checks of what the target made of position fixes.
#pragma once

#include <string>

#include "bench/checks/finding.hpp"
#include "bench/world/flight_record.hpp"

namespace canhil::checks {

/// Where more than two fixes in a row that the bench sent in a window were not answered; empty: nowhere.
std::string unanswered_fixes(const Observations& seen, const scenario::Window& window);

Finding judge(const scenario::PositionError& rule, const Observations& seen,
              const world::FlightRecord& truth);
Finding judge(const scenario::Fixes& rule, const Observations& seen);
Finding judge(const scenario::Coasting& rule, const Observations& seen);

}  // namespace canhil::checks
