#include "bench/mapping/reference_quantities.hpp"

#include <algorithm>
#include <array>

#include "bench/estimators/los_rate/quantities.hpp"
#include "bench/estimators/wind/quantities.hpp"
#include "bench/mapping/quantities.hpp"
#include "bench/world/attitude.hpp"

namespace canhil::mapping {
namespace {

using estimators::Truth;
using Value = std::optional<double>;

// A quantity from the flight record, at any time of the run.
template <class Of>
Value flown(const Truth& truth, std::int64_t t_us, Of of) {
  if (t_us < 0 || t_us > truth.flight.end_us()) return std::nullopt;
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

constexpr std::array known{
    ReferenceQuantity{&quantities::attitude_roll, "rad", true, attitude<&world::Euler::roll>},
    ReferenceQuantity{&quantities::attitude_pitch, "rad", true, attitude<&world::Euler::pitch>},
    ReferenceQuantity{&quantities::attitude_heading, "rad", true, attitude<&world::Euler::heading>},
    ReferenceQuantity{&quantities::velocity_north, "m/s", false, velocity<0>},
    ReferenceQuantity{&quantities::velocity_east, "m/s", false, velocity<1>},
    ReferenceQuantity{&quantities::velocity_down, "m/s", false, velocity<2>},
    ReferenceQuantity{&quantities::position_latitude, "rad", false, position<&world::Position::latitude>},
    ReferenceQuantity{&quantities::position_longitude, "rad", true, position<&world::Position::longitude>},
    ReferenceQuantity{&quantities::position_height, "m", false, position<&world::Position::height>},
    ReferenceQuantity{&quantities::rate_x, "rad/s", false, rate<0>},
    ReferenceQuantity{&quantities::rate_y, "rad/s", false, rate<1>},
    ReferenceQuantity{&quantities::rate_z, "rad/s", false, rate<2>},
    ReferenceQuantity{&quantities::specific_force_x, "m/s^2", false, force<0>},
    ReferenceQuantity{&quantities::specific_force_y, "m/s^2", false, force<1>},
    ReferenceQuantity{&quantities::specific_force_z, "m/s^2", false, force<2>},
    ReferenceQuantity{&quantities::los_rate_pitch, "rad/s", false, los_rate<&world::Planes<double>::pitch>},
    ReferenceQuantity{&quantities::los_rate_yaw, "rad/s", false, los_rate<&world::Planes<double>::yaw>},
    ReferenceQuantity{&quantities::wind_north, "m/s", false, wind<0>},
    ReferenceQuantity{&quantities::wind_east, "m/s", false, wind<1>},
    ReferenceQuantity{&quantities::wind_down, "m/s", false, wind<2>},
};

}  // namespace

std::span<const ReferenceQuantity> reference_quantities() { return known; }

const ReferenceQuantity* find_reference_quantity(std::string_view quantity) {
  const auto found =
      std::ranges::find(known, quantity, [](const ReferenceQuantity& one) { return one.quantity->name; });
  return found == known.end() ? nullptr : &*found;
}

}  // namespace canhil::mapping
