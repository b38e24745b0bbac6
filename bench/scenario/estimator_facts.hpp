// Facts about an estimator for scenarios; they are defined in the estimator's folder in bench/estimators.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "bench/scenario/node.hpp"

namespace canhil::scenario {

/// Which initial state the target receives.
enum class Start : std::uint8_t {
  navigation,     ///< the carrier's state, with the errors of [initial_error]
  per_run_truth,  ///< the state of the estimator's own plant (`truth`), with the errors of its table
                  ///< initial_error
  nothing         ///< the estimator uses no initial state
};

struct EstimatorFacts {
  std::span<const std::string_view> parameters{};  ///< used for suggestions if a name is misspelt; empty: any
  std::span<const std::string_view> nodes{};       ///< tables of the nodes that must be present
  std::string_view truth{};  ///< the plant with this output (PlantTable::shows) is required; empty: none is
  Start start = Start::navigation;
  std::string_view aided_by{};  ///< parameter that selects the source of the fixes; empty: no fixes
};

}  // namespace canhil::scenario
