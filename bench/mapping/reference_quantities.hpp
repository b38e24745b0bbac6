// The quantities that a mapped target may report, with their truth, and those that the bench derives from
// them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "bench/checks/estimator.hpp"
#include "bench/mapping/derived.hpp"
#include "bench/scenario/expression.hpp"
#include "bench/world/truth_values.hpp"

namespace canhil::mapping {

/// The truth of an innovation: it is zero if the filter is right.
struct Zero {};

struct ReferenceQuantity {
  const quantities::Quantity* quantity = nullptr;
  std::string_view si{};  ///< SI unit
  bool turns = false;     ///< an angle: values that differ by a full turn are equal
  /// What is compared with the reported value; nothing: the bench has no truth of the quantity.
  std::variant<std::monostate, const world::TruthValue*, Zero, scenario::Expression> truth{};

  [[nodiscard]] bool has_truth() const { return !std::holds_alternative<std::monostate>(truth); }

  /// The quantities from which the bench derives this one; empty: the target reports it itself.
  std::span<const quantities::Quantity* const> of{};
  Derive derive = nullptr;
  bool of_sigmas = false;  ///< derived only if the target reports the sigmas of all quantities in `of`
};

/// All quantities that a mapped target may report, followed by those that are derived from them.
std::span<const ReferenceQuantity> reference_quantities();
/// The truth of a quantity that a target reports, at a time [us] of the run, in SI; none: there is no truth.
std::optional<double> truth_of(const ReferenceQuantity& quantity, const estimators::Truth& truth,
                               std::int64_t t_us);
/// Why a scenario has no truth of the quantity; empty: it has one.
std::string why_no_truth(const ReferenceQuantity& quantity, const scenario::Scenario& scenario);
/// Whether the quantity is a latitude or a longitude.
bool is_on_the_ground(const ReferenceQuantity& quantity);
/// The quantity of this name; null: a mapped target can have no such quantity.
const ReferenceQuantity* find_reference_quantity(std::string_view quantity);

}  // namespace canhil::mapping
