// Which bars stand on which series.
#pragma once

#include <vector>

#include "bench/report/series.hpp"

namespace canhil::report {

/// Gives each series the bars of the checks that judge it.
void add_bars(std::vector<Series>& all, const scenario::Scenario& scenario);

}  // namespace canhil::report
