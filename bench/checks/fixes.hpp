// Fixes that were sent and not answered.
#pragma once

#include <string>

#include "bench/checks/observations.hpp"

namespace canhil::checks {

/// Where more than two fixes in a row that the bench sent in a window were not answered; empty: nowhere.
std::string unanswered_fixes(const Observations& seen, const scenario::Window& window);

}  // namespace canhil::checks
