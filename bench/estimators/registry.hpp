// A line an estimator: registry.cpp.
#pragma once

#include <map>
#include <string>

#include "bench/checks/estimator.hpp"

namespace canhil {
struct MessageInfo;
}

namespace canhil::estimators {

/// All of them. Of several in one scenario a campaign keeps the samples of the last.
std::span<const Estimator* const> all();
/// Those that a scenario's target may be: all of them, or the one that a mapping describes.
std::span<const Estimator* const> in(const scenario::Scenario& scenario);
/// None: null.
const Estimator* find(std::string_view name);
/// Whose samples have these columns (quantities::names); none: null.
const Estimator* telling(std::string_view columns);
/// Who of them sends a message: its group is one of those that the estimator's messages close; none: null.
const Estimator* sending(const MessageInfo& message);
/// Whose samples a campaign keeps of a scenario.
const Estimator& of(const scenario::Scenario& scenario);
/// What scenarios have to know of them, by name, for scenario::DbcVocabulary.
std::map<std::string, scenario::EstimatorFacts, std::less<>> facts();
/// Every quantity that any of them tells, each once, in the order of the registry.
std::span<const quantities::Quantity* const> every_quantity();

}  // namespace canhil::estimators
