#include "bench/mapping/reference_quantities.hpp"

#include <algorithm>
#include <array>

#include "bench/estimators/inflight_alignment/quantities.hpp"
#include "bench/estimators/los_rate/quantities.hpp"
#include "bench/estimators/transfer_alignment/quantities.hpp"
#include "bench/estimators/wind/quantities.hpp"
#include "bench/mapping/quantities.hpp"
#include "bench/scenario/scenario.hpp"
#include "bench/world/attitude.hpp"

namespace canhil::mapping {
namespace {

using estimators::Truth;
using Value = std::optional<double>;

// A quantity from the flight record, at any time of the run.
template <class Of>
Value flown(const Truth& truth, std::int64_t t_us, Of of) {
  if (!truth.flight.is_known() || t_us < 0 || t_us > truth.flight.end_us()) return std::nullopt;
  return of(truth.flight.at(t_us));
}
// A quantity from the glide record, at the last step at or before the time.
template <class Of>
Value glided(const Truth& truth, std::int64_t t_us, Of of) {
  if (truth.glide == nullptr || t_us < 0 || t_us > truth.glide->end_us()) return std::nullopt;
  return of(truth.glide->at(t_us));
}
// A quantity from the glide record if there is one, otherwise from the flight record.
template <class Of>
Value moved(const Truth& truth, std::int64_t t_us, Of of) {
  return truth.glide != nullptr ? glided(truth, t_us, of) : flown(truth, t_us, of);
}

template <double world::Euler::*angle>
Value attitude(const Truth& truth, std::int64_t t_us) {
  return moved(truth, t_us, [](const auto& at) { return world::euler_from(at.C_bn).*angle; });
}
template <int axis>
Value velocity(const Truth& truth, std::int64_t t_us) {
  return moved(truth, t_us, [](const auto& at) { return at.v_eb_n[axis]; });
}
template <double world::Position::*coordinate>
Value position(const Truth& truth, std::int64_t t_us) {
  return flown(truth, t_us, [](const world::Truth& at) { return at.position.*coordinate; });
}
template <int axis>
Value rate(const Truth& truth, std::int64_t t_us) {
  return flown(truth, t_us, [](const world::Truth& at) { return at.omega_ib_b[axis]; });
}
template <int axis>
Value force(const Truth& truth, std::int64_t t_us) {
  return flown(truth, t_us, [](const world::Truth& at) { return at.f_ib_b[axis]; });
}
template <int axis>
Value wind(const Truth& truth, std::int64_t t_us) {
  return glided(truth, t_us, [](const world::GlideTruth& at) { return at.wind_n[axis]; });
}
// A quantity from the engagement record, at a sample of the seeker.
template <double world::Planes<double>::*plane>
Value los_rate(const Truth& truth, std::int64_t t_us) {
  const world::EngagementTruth* epoch = truth.engagement == nullptr ? nullptr : truth.engagement->at(t_us);
  if (epoch == nullptr) return std::nullopt;
  return epoch->los_rate.*plane;
}

// An innovation is zero if the filter is right.
Value none(const Truth& /*truth*/, std::int64_t /*t_us*/) { return 0; }

using scenario::TruthOf;
constexpr std::array in_flight{TruthOf::navigation};
constexpr std::array in_motion{TruthOf::glide, TruthOf::navigation};
constexpr std::array in_glide{TruthOf::glide};
constexpr std::array in_engagement{TruthOf::engagement};

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

constexpr ReferenceQuantity derived(const quantities::Quantity& quantity, std::string_view si,
                                    std::span<const TruthOf> from, std::span<const Of> of, Derive derive) {
  return {.quantity = &quantity, .si = si, .from = from, .of = of, .derive = derive};
}
constexpr ReferenceQuantity normalised(const quantities::Quantity& quantity, std::span<const TruthOf> from,
                                       std::span<const Of> of) {
  return {.quantity = &quantity, .from = from, .of = of, .derive = normalised_squared, .of_sigmas = true};
}

constexpr std::array known{
    ReferenceQuantity{&quantities::attitude_roll, "rad", true, in_motion, attitude<&world::Euler::roll>},
    ReferenceQuantity{&quantities::attitude_pitch, "rad", true, in_motion, attitude<&world::Euler::pitch>},
    ReferenceQuantity{&quantities::attitude_heading, "rad", true, in_motion,
                      attitude<&world::Euler::heading>},
    ReferenceQuantity{&quantities::velocity_north, "m/s", false, in_motion, velocity<0>},
    ReferenceQuantity{&quantities::velocity_east, "m/s", false, in_motion, velocity<1>},
    ReferenceQuantity{&quantities::velocity_down, "m/s", false, in_motion, velocity<2>},
    ReferenceQuantity{&quantities::position_latitude, "rad", false, in_flight,
                      position<&world::Position::latitude>},
    ReferenceQuantity{&quantities::position_longitude, "rad", true, in_flight,
                      position<&world::Position::longitude>},
    ReferenceQuantity{&quantities::position_height, "m", false, in_flight,
                      position<&world::Position::height>},
    ReferenceQuantity{&quantities::rate_x, "rad/s", false, in_flight, rate<0>},
    ReferenceQuantity{&quantities::rate_y, "rad/s", false, in_flight, rate<1>},
    ReferenceQuantity{&quantities::rate_z, "rad/s", false, in_flight, rate<2>},
    ReferenceQuantity{&quantities::specific_force_x, "m/s^2", false, in_flight, force<0>},
    ReferenceQuantity{&quantities::specific_force_y, "m/s^2", false, in_flight, force<1>},
    ReferenceQuantity{&quantities::specific_force_z, "m/s^2", false, in_flight, force<2>},
    ReferenceQuantity{&quantities::los_rate_pitch, "rad/s", false, in_engagement,
                      los_rate<&world::Planes<double>::pitch>},
    ReferenceQuantity{&quantities::los_rate_yaw, "rad/s", false, in_engagement,
                      los_rate<&world::Planes<double>::yaw>},
    ReferenceQuantity{&quantities::wind_north, "m/s", false, in_glide, wind<0>},
    ReferenceQuantity{&quantities::wind_east, "m/s", false, in_glide, wind<1>},
    ReferenceQuantity{&quantities::wind_down, "m/s", false, in_glide, wind<2>},
    ReferenceQuantity{&quantities::velocity_innovation_north, "m/s", false, {}, none},
    ReferenceQuantity{&quantities::velocity_innovation_east, "m/s", false, {}, none},
    ReferenceQuantity{&quantities::velocity_innovation_down, "m/s", false, {}, none},
    ReferenceQuantity{&quantities::position_innovation_north, "m", false, {}, none},
    ReferenceQuantity{&quantities::position_innovation_east, "m", false, {}, none},
    ReferenceQuantity{&quantities::position_innovation_down, "m", false, {}, none},
    ReferenceQuantity{&quantities::innovation_nis, "", false, {}, none},
    derived(quantities::position_north, "m", in_flight, latitude, north_of_latitude),
    derived(quantities::position_east, "m", in_flight, longitude, east_of_longitude),
    derived(quantities::position_down, "m", in_flight, height, down_of_height),
    derived(quantities::position_horizontal, "m", in_flight, on_the_ground, horizontal),
    derived(quantities::velocity_norm, "m/s", in_motion, velocities, magnitude),
    derived(quantities::wind_norm, "m/s", in_glide, winds, magnitude),
    normalised(quantities::heading_nees, in_motion, heading),
    normalised(quantities::attitude_nees, in_motion, angles),
    normalised(quantities::velocity_nees, in_motion, velocities),
    normalised(quantities::position_horizontal_nees, in_flight, on_the_ground),
    normalised(quantities::position_nees, in_flight, coordinates),
    normalised(quantities::wind_nees, in_glide, winds),
    normalised(quantities::velocity_nis, {}, velocity_innovations),
    normalised(quantities::position_nis, {}, position_innovations),
};

}  // namespace

std::span<const ReferenceQuantity> reference_quantities() { return known; }

std::string why_no_truth(const ReferenceQuantity& quantity, const scenario::Scenario& scenario) {
  if (quantity.from.empty()) return {};
  // A glide replaces the flight of the carrier.
  const TruthOf of = scenario.glide ? quantity.from.front() : quantity.from.back();
  return scenario::why_no_truth(scenario, of);
}

bool is_on_the_ground(const ReferenceQuantity& quantity) {
  return std::ranges::find(on_the_ground, quantity.quantity) != on_the_ground.end();
}

const ReferenceQuantity* find_reference_quantity(std::string_view quantity) {
  const auto found =
      std::ranges::find(known, quantity, [](const ReferenceQuantity& one) { return one.quantity->name; });
  return found == known.end() ? nullptr : &*found;
}

}  // namespace canhil::mapping
