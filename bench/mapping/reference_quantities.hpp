// The quantities that a mapped target may report, and their truth.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "bench/checks/estimator.hpp"
#include "bench/scenario/node.hpp"

namespace canhil::mapping {

struct ReferenceQuantity {
  const quantities::Quantity* quantity = nullptr;
  std::string_view si;  ///< SI unit
  bool turns = false;   ///< an angle: values that differ by a full turn are equal
  /// The truths that contain the quantity. The first of them that the scenario has is used.
  std::span<const scenario::TruthOf> from{};
  /// The truth at a time [us] of the run, in SI; none: there is no truth.
  std::optional<double> (*truth)(const estimators::Truth& truth, std::int64_t t_us) = nullptr;
};

/// All quantities that a mapped target may report.
std::span<const ReferenceQuantity> reference_quantities();
/// Why a scenario has no truth of the quantity; empty: it has one.
std::string why_no_truth(const ReferenceQuantity& quantity, const scenario::Scenario& scenario);
/// The quantity of this name; null if a mapped target may not report it.
const ReferenceQuantity* find_reference_quantity(std::string_view quantity);

}  // namespace canhil::mapping
