// Formats a campaign's results: as text for people, as JSON for programs.
#pragma once

#include <string>

#include "bench/campaign/evaluate.hpp"

namespace canhil::campaign {

/// A text report: how the runs ended, then every answer with its limit.
std::string text(const Campaign& campaign, const Evaluation& evaluation);

/// One JSON object, which also contains the curves. If a value has a unit, the key of the value ends with the
/// name of the unit.
std::string json(const Campaign& campaign, const Evaluation& evaluation);

}  // namespace canhil::campaign
