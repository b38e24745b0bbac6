// Reduces a check that was judged in each run to one answer over the runs of a variant.
#pragma once

#include <vector>

#include "bench/campaign/answer.hpp"
#include "bench/campaign/campaign.hpp"
#include "bench/campaign/judged.hpp"

namespace canhil::campaign {

/// The answers of all checks of a variant: how many runs pass, and the run that is nearest to the limit or
/// furthest beyond it. `judged`: of each run. A run that ended early fails each check of its scenario.
std::vector<Answer> answers_of_checks(const Campaign& campaign, std::size_t variant, const Runs& runs,
                                      const std::vector<Judged>& judged);

}  // namespace canhil::campaign
