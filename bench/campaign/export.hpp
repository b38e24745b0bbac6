// Exports results as CSV.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/campaign/store.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::campaign {

inline constexpr double any_time_s = 1e9;

/// What of the results is exported.
struct Chosen {
  std::vector<std::string> variants{};    ///< by name; empty: all
  std::vector<std::string> quantities{};  ///< by name; empty: all
  double from_s = -any_time_s, to_s = any_time_s;
};

/// Writes comma-separated values in the columns variant, run, t_s, quantity, unit and value. Values are in SI
/// units, angles in rad. The variants follow one another; each sample has one line per quantity, but a value
/// that was not reported has no line. If a sample covers an interval of the time to go
/// (Layout::to_go_stretch_us), t_s is minus the time to go. Returns an Error if the results cannot be read,
/// if a chosen variant or quantity is in none of them, or if `give` fails.
Result<void> export_csv(const Campaign& campaign, const Store& store, const Chosen& chosen,
                        const std::function<Result<void>(std::string_view text)>& give);

}  // namespace canhil::campaign
