// Formats a campaign's results: as text for people, as JSON for programs.
#pragma once

#include <string>

#include "bench/campaign/evaluate.hpp"

namespace canhil::campaign {

/// A text report: how the runs ended, then every answer with its limit.
std::string text(const Campaign& campaign, const Evaluation& evaluation);

/// One JSON object, which also contains the curves. The key of a value with a unit ends in the unit.
std::string json(const Campaign& campaign, const Evaluation& evaluation);

}  // namespace canhil::campaign
