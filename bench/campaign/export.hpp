// Results as a table that anybody can read.
#pragma once

#include <functional>
#include <string_view>

#include "bench/campaign/store.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::campaign {

/// Gives lines of comma-separated values: variant, run, t_s, quantity, unit, value, in SI and rad; a line a
/// sample and quantity, variant by variant. What was not told has no line. Of samples by time to go t_s is
/// minus the time to go. Error: the results cannot be read.
Result<void> export_csv(const Campaign& campaign, const Store& store,
                        const std::function<Result<void>(std::string_view text)>& give);

}  // namespace canhil::campaign
