// The flags that a target reported over the time of a run.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/drive/session.hpp"

namespace canhil::report {

/// Receives a flag, its estimator, and its changes: the time of the first answer that could report it, and of
/// each answer in which its state is another than in the one before.
using FlagOf = std::function<void(std::string_view estimator, std::string_view flag,
                                  const std::vector<std::pair<std::int64_t, bool>>& changes)>;
/// Passes on the flags of the scenario's estimators that were reported.
void give_flags(const scenario::Scenario& scenario, const drive::Run& run, const FlagOf& give);

}  // namespace canhil::report
