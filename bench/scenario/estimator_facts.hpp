// What a scenario has to know of an estimator; its folder in bench/estimators says it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "bench/scenario/node.hpp"

namespace canhil::scenario {

/// What the target is told of the start.
enum class Start : std::uint8_t {
  navigation,     ///< the carrier's state, with the errors of [initial_error]
  per_run_truth,  ///< that of its own truth, which has errors of its own
  nothing         ///< it makes nothing of what it is told
};

struct EstimatorFacts {
  std::span<const std::string_view> parameters{};  ///< that it has: what a misspelt one may mean; empty: any
  std::span<const std::string_view> nodes{};       ///< whose tables it cannot do without
  std::optional<TruthOf> truth{};                  ///< whose table it cannot do without
  Start start = Start::navigation;
  std::string_view start_errors{};  ///< the table of its own truth's errors
  std::string_view aided_by{};      ///< its parameter that says whose fixes it takes; empty: it takes none
};

}  // namespace canhil::scenario
