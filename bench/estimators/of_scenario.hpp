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

/// The minimum interval [us] between two answers, from the parameter output_interval_ms of the scenario.
/// None: the scenario does not set this parameter.
std::optional<double> output_interval_us(const scenario::TargetSetup& setup);

/// The answer interval [s] of each group that the target sends at a minimum interval when the stimuli come
/// faster (Estimator::of_own_interval). This is the interval that the scenario sets or, if the scenario sets
/// none, the cycle time in the DBC.
std::map<std::string_view, double> own_intervals_s(const scenario::Scenario& scenario);

/// For each sample group of the bench: how many of the scenario's estimators answer it.
std::map<std::string_view, std::uint64_t> takers(const scenario::Scenario& scenario);

}  // namespace canhil::estimators
