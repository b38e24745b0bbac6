#include "bench/mapping/reference_quantities.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "bench/estimators/inflight_alignment/quantities.hpp"
#include "bench/estimators/los_rate/quantities.hpp"
#include "bench/estimators/transfer_alignment/quantities.hpp"
#include "bench/estimators/wind/quantities.hpp"
#include "bench/mapping/quantities.hpp"
#include "bench/scenario/scenario.hpp"

namespace canhil::mapping {
namespace {

using Of = const quantities::Quantity*;
constexpr std::array<Of, 1> latitude{&quantities::position_latitude},
    longitude{&quantities::position_longitude}, height{&quantities::position_height},
    heading{&quantities::attitude_heading};
constexpr std::array<Of, 2> on_the_ground{&quantities::position_latitude, &quantities::position_longitude};
constexpr std::array<Of, 3> coordinates{&quantities::position_latitude, &quantities::position_longitude,
                                        &quantities::position_height},
    angles{&quantities::attitude_roll, &quantities::attitude_pitch, &quantities::attitude_heading},
    velocities{&quantities::velocity_north, &quantities::velocity_east, &quantities::velocity_down},
    winds{&quantities::wind_north, &quantities::wind_east, &quantities::wind_down},
    velocity_innovations{&quantities::velocity_innovation_north, &quantities::velocity_innovation_east,
                         &quantities::velocity_innovation_down},
    position_innovations{&quantities::position_innovation_north, &quantities::position_innovation_east,
                         &quantities::position_innovation_down};

ReferenceQuantity derived(const quantities::Quantity& quantity, std::string_view si, std::span<const Of> of,
                          Derive derive) {
  return {.quantity = &quantity, .si = si, .of = of, .derive = derive};
}
ReferenceQuantity normalised(const quantities::Quantity& quantity, std::span<const Of> of) {
  return {.quantity = &quantity, .of = of, .derive = normalised_squared, .of_sigmas = true};
}
ReferenceQuantity innovation(const quantities::Quantity& quantity, std::string_view si) {
  return {.quantity = &quantity, .si = si, .truth = Zero{}};
}
// A quantity that the truth has under the same name.
ReferenceQuantity of_truth(const quantities::Quantity& quantity) {
  const world::TruthValue* value = world::find_truth_value(quantity.name);
  return {.quantity = &quantity, .si = value->si, .turns = value->turns, .truth = value};
}

const std::vector<ReferenceQuantity>& known() {
  static const std::vector<ReferenceQuantity> all{
      of_truth(quantities::attitude_roll),
      of_truth(quantities::attitude_pitch),
      of_truth(quantities::attitude_heading),
      of_truth(quantities::velocity_north),
      of_truth(quantities::velocity_east),
      of_truth(quantities::velocity_down),
      of_truth(quantities::velocity_x),
      of_truth(quantities::velocity_y),
      of_truth(quantities::velocity_z),
      of_truth(quantities::ground_speed),
      of_truth(quantities::course),
      of_truth(quantities::position_latitude),
      of_truth(quantities::position_longitude),
      of_truth(quantities::position_height),
      of_truth(quantities::rate_x),
      of_truth(quantities::rate_y),
      of_truth(quantities::rate_z),
      of_truth(quantities::specific_force_x),
      of_truth(quantities::specific_force_y),
      of_truth(quantities::specific_force_z),
      of_truth(quantities::los_rate_pitch),
      of_truth(quantities::los_rate_yaw),
      of_truth(quantities::wind_north),
      of_truth(quantities::wind_east),
      of_truth(quantities::wind_down),
      innovation(quantities::velocity_innovation_north, "m/s"),
      innovation(quantities::velocity_innovation_east, "m/s"),
      innovation(quantities::velocity_innovation_down, "m/s"),
      innovation(quantities::position_innovation_north, "m"),
      innovation(quantities::position_innovation_east, "m"),
      innovation(quantities::position_innovation_down, "m"),
      innovation(quantities::innovation_nis, ""),
      derived(quantities::position_north, "m", latitude, north_of_latitude),
      derived(quantities::position_east, "m", longitude, east_of_longitude),
      derived(quantities::position_down, "m", height, down_of_height),
      derived(quantities::position_horizontal, "m", on_the_ground, horizontal),
      derived(quantities::velocity_norm, "m/s", velocities, magnitude),
      derived(quantities::wind_norm, "m/s", winds, magnitude),
      normalised(quantities::heading_nees, heading),
      normalised(quantities::attitude_nees, angles),
      normalised(quantities::velocity_nees, velocities),
      normalised(quantities::position_horizontal_nees, on_the_ground),
      normalised(quantities::position_nees, coordinates),
      normalised(quantities::wind_nees, winds),
      normalised(quantities::velocity_nis, velocity_innovations),
      normalised(quantities::position_nis, position_innovations),
  };
  return all;
}

}  // namespace

std::span<const ReferenceQuantity> reference_quantities() { return known(); }

std::optional<double> truth_of(const ReferenceQuantity& quantity, const estimators::Truth& truth,
                               std::int64_t t_us) {
  const world::Truths truths = estimators::truths_of(truth);
  if (const auto* value = std::get_if<const world::TruthValue*>(&quantity.truth))
    return (*value)->at(truths, t_us);
  if (const auto* expression = std::get_if<scenario::Expression>(&quantity.truth))
    return expression->at(truths, t_us);
  return std::holds_alternative<Zero>(quantity.truth) ? std::optional(0.0) : std::nullopt;
}

std::string why_no_truth(const ReferenceQuantity& quantity, const scenario::Scenario& scenario) {
  if (!quantity.of.empty())
    return why_no_truth(*find_reference_quantity(quantity.of.front()->name), scenario);
  if (const auto* value = std::get_if<const world::TruthValue*>(&quantity.truth))
    return scenario::why_no_truth(scenario, **value);
  if (const auto* expression = std::get_if<scenario::Expression>(&quantity.truth))
    return scenario::why_no_truth(scenario, *expression);
  return std::holds_alternative<Zero>(quantity.truth) ? "" : "no truth: the mapping gives none";
}

bool is_on_the_ground(const ReferenceQuantity& quantity) {
  return std::ranges::find(on_the_ground, quantity.quantity) != on_the_ground.end();
}

const ReferenceQuantity* find_reference_quantity(std::string_view quantity) {
  const auto found =
      std::ranges::find(known(), quantity, [](const ReferenceQuantity& one) { return one.quantity->name; });
  return found == known().end() ? nullptr : &*found;
}

}  // namespace canhil::mapping
