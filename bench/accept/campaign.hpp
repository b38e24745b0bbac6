// Flies the campaigns of a suite.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "bench/accept/accept.hpp"

namespace canhil::accept {

/// The requirements that a campaign of the suite tests. Returns an Error if its file is wrong.
Result<std::vector<std::string>> tested_by_campaign(const Suite& suite, const std::string& name);

/// Flies a campaign of the suite against the target and judges its metrics. What a campaign that ended early
/// would have judged is not measured. Returns an Error if it cannot be flown for a reason that is not the
/// target's.
Result<std::vector<Item>> fly_campaign(const Suite& suite, const std::string& name, const Options& options,
                                       const std::atomic<bool>& stop);

}  // namespace canhil::accept
