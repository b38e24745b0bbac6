// A line an estimator.
#include <algorithm>
#include <array>
#include <vector>

#include "bench/estimators/estimator.hpp"
#include "bench/estimators/inflight_alignment/inflight_alignment.hpp"
#include "bench/estimators/los_rate/los_rate.hpp"
#include "bench/estimators/transfer_alignment/transfer_alignment.hpp"
#include "bench/estimators/wind/wind.hpp"
#include "bench/scenario/scenario.hpp"

namespace canhil::estimators {
namespace {

constexpr std::array<const Estimator*, 4> registered{
    &transfer_alignment,
    &inflight_alignment,
    &wind,
    &los_rate,
};

}  // namespace

std::span<const Estimator* const> all() { return registered; }

const Estimator* find(std::string_view name) {
  const auto found = std::ranges::find(registered, name, [](const Estimator* one) { return one->name; });
  return found == registered.end() ? nullptr : *found;
}

const Estimator* telling(std::string_view columns) {
  const auto found = std::ranges::find_if(
      registered, [&](const Estimator* one) { return quantities::names(one->layout) == columns; });
  return found == registered.end() ? nullptr : *found;
}

const Estimator& of(const scenario::Scenario& scenario) {
  const Estimator* last = registered.front();
  for (const Estimator* one : registered) {
    if (scenario.runs(one->name)) last = one;
  }
  return *last;
}

std::span<const quantities::Quantity* const> every_quantity() {
  static const std::vector<const quantities::Quantity*> each = [] {
    std::vector<const quantities::Quantity*> found;
    const auto add = [&](const quantities::Quantity* quantity) {
      if (std::ranges::find(found, quantity) == found.end()) found.push_back(quantity);
    };
    for (const Estimator* one : registered) {
      for (const quantities::Quantity* kept : one->layout.kept) add(kept);
      for (const quantities::Derived& derived : one->layout.derived) add(derived.quantity);
      for (const quantities::Quantity* quantity : one->of_runs_alone) add(quantity);
    }
    return found;
  }();
  return each;
}

}  // namespace canhil::estimators
