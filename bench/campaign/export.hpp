// Exports results as CSV.
#pragma once

#include <functional>
#include <string_view>

#include "bench/campaign/store.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::campaign {

/// Writes comma-separated values: variant, run, t_s, quantity, unit, value, in SI and rad. There is one line
/// per sample and quantity, variant by variant; values that were not reported have no line. For samples by
/// time to go, t_s is minus the time to go. Returns an Error if the results cannot be read or if `give`
/// fails.
Result<void> export_csv(const Campaign& campaign, const Store& store,
                        const std::function<Result<void>(std::string_view text)>& give);

}  // namespace canhil::campaign
