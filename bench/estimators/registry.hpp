// The registry of estimators: registry.cpp has one line for each.
#pragma once

#include "bench/checks/estimator.hpp"

namespace canhil::estimators {

/// All estimators. If several of them run in a scenario, a campaign keeps only the samples of the one that
/// comes last in this list.
std::span<const Estimator* const> all();
/// The estimators that may run in a scenario. Without a mapping these are all estimators; with a mapping,
/// only the mapped target.
std::span<const Estimator* const> in(const scenario::Scenario& scenario);
/// The estimator of this name; null if there is none.
const Estimator* find(std::string_view name);
/// The estimator whose samples have these columns (quantities::names); null if there is none.
const Estimator* telling(std::string_view columns);
/// The estimator whose samples a campaign keeps for a scenario.
const Estimator& of(const scenario::Scenario& scenario);
/// Every quantity that any estimator reports, each once, in the order of the registry.
std::span<const quantities::Quantity* const> every_quantity();

}  // namespace canhil::estimators
