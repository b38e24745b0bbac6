// What a run showed as a table that anybody can read: a line an answer and quantity.
#pragma once

#include <string>

#include "bench/drive/session.hpp"
#include "bench/scenario/scenario.hpp"

namespace canhil::report {

/// Comma-separated: t_s (time of validity), estimator, quantity, unit, estimate, truth, error, sigma, in SI
/// and rad. Empty fields were not told. A statistic or an innovation is in `estimate`. The order is that of
/// estimators, of their quantities, of time.
std::string csv(const scenario::Scenario& scenario, const drive::Run& run);

}  // namespace canhil::report
