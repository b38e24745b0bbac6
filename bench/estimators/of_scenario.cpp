#include "bench/estimators/of_scenario.hpp"

#include <algorithm>
#include <set>

#include "bench/estimators/registry.hpp"
#include "bench/scenario/scenario.hpp"
#include "messages/canhil.hpp"

namespace canhil::estimators {

std::optional<double> output_interval_us(const scenario::TargetSetup& setup) {
  const auto found = std::ranges::find(setup.parameters, name_of(messages::Parameter::output_interval_ms),
                                       &scenario::Parameter::name);
  return found == setup.parameters.end() ? std::nullopt : std::optional(1e3 * found->value);
}

std::map<std::string_view, double> own_intervals_s(const scenario::Scenario& scenario) {
  std::map<std::string_view, double> all;
  for (const scenario::TargetSetup& setup : scenario.targets) {
    const Estimator* estimator = find(setup.estimator);
    if (estimator == nullptr || estimator->of_own_interval.empty()) continue;
    const auto info =
        std::ranges::find(messages::all_messages, estimator->of_own_interval, &MessageInfo::sample_group);
    if (info == messages::all_messages.end()) continue;
    const auto cycle_us = static_cast<double>(info->cycle_time_us);
    all[estimator->of_own_interval] = 1e-6 * output_interval_us(setup).value_or(cycle_us);
  }
  return all;
}

std::map<std::string_view, std::uint64_t> takers(const scenario::Scenario& scenario) {
  std::map<std::string_view, std::uint64_t> all;
  for (const scenario::TargetSetup& setup : scenario.targets) {
    const Estimator* estimator = find(setup.estimator);
    if (estimator == nullptr) continue;
    std::set<std::string_view> groups;
    for (const std::string_view closing : estimator->closing) {
      const auto info = std::ranges::find(messages::all_messages, closing, &MessageInfo::name);
      if (info != messages::all_messages.end()) groups.insert(info->answers.begin(), info->answers.end());
    }
    for (const std::string_view group : groups) ++all[group];
  }
  return all;
}

}  // namespace canhil::estimators
