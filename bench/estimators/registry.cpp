// Registers the estimators, one line for each.
#include <algorithm>
#include <array>
#include <vector>

#include "bench/estimators/inflight_alignment/inflight_alignment.hpp"
#include "bench/estimators/los_rate/los_rate.hpp"
#include "bench/estimators/registry.hpp"
#include "bench/estimators/transfer_alignment/transfer_alignment.hpp"
#include "bench/estimators/wind/wind.hpp"
#include "bench/scenario/binding.hpp"
#include "bench/scenario/scenario.hpp"

namespace canhil::estimators {
namespace {

constexpr std::array registered{
    &transfer_alignment,
    &inflight_alignment,
    &wind,
    &los_rate,
};

}  // namespace

std::span<const Estimator* const> all() { return registered; }

const Estimator* find(std::string_view name) { return find(registered, name); }

const Estimator* telling(std::string_view columns) {
  const auto found = std::ranges::find_if(
      registered, [&](const Estimator* one) { return quantities::names(one->layout) == columns; });
  return found == registered.end() ? nullptr : *found;
}

std::span<const Estimator* const> in(const scenario::Scenario& scenario) {
  return scenario.binding->estimators;
}

const Estimator& of(const scenario::Scenario& scenario) {
  const Estimator* last = in(scenario).front();
  for (const Estimator* one : in(scenario)) {
    if (scenario.runs(one->name)) last = one;
  }
  return *last;
}

std::span<const quantities::Quantity* const> every_quantity() {
  static const std::vector<const quantities::Quantity*> each = quantities_of(registered);
  return each;
}

}  // namespace canhil::estimators
