// Properties of a run's answers that follow from the estimators of its scenario.
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

/// The minimum interval [us] between answers that a scenario sets (output_interval_ms); none: not set.
std::optional<double> output_interval_us(const scenario::TargetSetup& setup);

/// The answer intervals [s] of the groups that the target sends at a minimum interval if the stimuli come
/// faster (Estimator::of_own_interval): the interval that the scenario sets; if it sets none, the cycle time
/// in the DBC.
std::map<std::string_view, double> own_intervals_s(const scenario::Scenario& scenario);

/// For each sample group of the bench: how many of the scenario's estimators answer it.
std::map<std::string_view, std::uint64_t> takers(const scenario::Scenario& scenario);

}  // namespace canhil::estimators
