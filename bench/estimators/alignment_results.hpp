// What estimators of attitude and velocity have in common in what people are told.
#pragma once

#include <span>
#include <vector>

#include "bench/checks/results.hpp"
#include "bench/estimators/navigation.hpp"
#include "bench/quantities/track.hpp"

namespace canhil::estimators {

/// When the heading error entered each band [angle] for good, and the errors of the last answer.
std::vector<ResultLine> alignment_results(const std::vector<NavigationError>& errors,
                                          std::span<const double> bands, const quantities::Unit& angle);

}  // namespace canhil::estimators
