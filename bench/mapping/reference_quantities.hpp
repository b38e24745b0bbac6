// Quantities that a mapped target may tell, and their truth.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "bench/checks/estimator.hpp"

namespace canhil::mapping {

struct ReferenceQuantity {
  const quantities::Quantity* quantity = nullptr;
  std::string_view si;  ///< its unit
  bool turns = false;   ///< a whole turn more is the same
  /// At a time [us] of the run [SI]; none: there is no truth.
  std::optional<double> (*truth)(const estimators::Truth& truth, std::int64_t t_us) = nullptr;
};

/// All of them.
std::span<const ReferenceQuantity> reference_quantities();
/// None: null.
const ReferenceQuantity* find_reference_quantity(std::string_view quantity);

}  // namespace canhil::mapping
