// Exports results as CSV.
#pragma once

#include <functional>
#include <string_view>

#include "bench/campaign/store.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::campaign {

/// Writes comma-separated values in the columns variant, run, t_s, quantity, unit and value. Values are in SI
/// units, angles in rad. The variants follow one another; each sample has one line per quantity, but a value
/// that was not reported has no line. If a sample covers an interval of the time to go
/// (Layout::to_go_stretch_us), t_s is minus the time to go. Returns an Error if the results cannot be read or
/// if `give` fails.
Result<void> export_csv(const Campaign& campaign, const Store& store,
                        const std::function<Result<void>(std::string_view text)>& give);

}  // namespace canhil::campaign
