// What follows for the answers of a run from the estimators that its scenario runs.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

#include "bench/scenario/target_setup.hpp"

namespace canhil::scenario {
struct Scenario;
}

namespace canhil::estimators {

/// The least interval [us] between answers that a scenario sets (output_interval_ms); none: it sets none.
std::optional<double> output_interval_us(const scenario::TargetSetup& setup);

/// By group of answers that keep an interval of their own: that interval [s], of the scenario or else the
/// cycle time in the DBC.
std::map<std::string_view, double> own_intervals_s(const scenario::Scenario& scenario);

/// By sample group of the bench: how many of the estimators that the scenario runs answer it.
std::map<std::string_view, std::uint64_t> takers(const scenario::Scenario& scenario);

}  // namespace canhil::estimators
