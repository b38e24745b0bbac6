#include "bench/mapping/truths.hpp"

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

// Of the navigation's truth, at any time of the run.
template <double (*of)(const world::Truth&)>
Value flown(const Truth& truth, std::int64_t t_us) {
  if (t_us < 0 || t_us > truth.flight.end_us()) return std::nullopt;
  return of(truth.flight.at(t_us));
}
// Of the glider's truth, at the step before.
template <double (*of)(const world::GlideTruth&)>
Value glided(const Truth& truth, std::int64_t t_us) {
  if (truth.glide == nullptr || t_us < 0 || t_us > truth.glide->end_us()) return std::nullopt;
  return of(truth.glide->at(t_us));
}
// Of the engagement's, at a sample of the seeker.
template <double (*of)(const world::EngagementTruth&)>
Value engaged(const Truth& truth, std::int64_t t_us) {
  const world::EngagementTruth* epoch = truth.engagement == nullptr ? nullptr : truth.engagement->at(t_us);
  if (epoch == nullptr) return std::nullopt;
  return of(*epoch);
}

template <double world::Euler::*angle>
Value attitude(const Truth& truth, std::int64_t t_us) {
  if (truth.glide != nullptr)
    return glided<[](const world::GlideTruth& at) { return world::euler_from(at.C_bn).*angle; }>(truth, t_us);
  return flown<[](const world::Truth& at) { return world::euler_from(at.C_bn).*angle; }>(truth, t_us);
}
template <int axis>
Value velocity(const Truth& truth, std::int64_t t_us) {
  if (truth.glide != nullptr)
    return glided<[](const world::GlideTruth& at) { return at.v_eb_n[axis]; }>(truth, t_us);
  return flown<[](const world::Truth& at) { return at.v_eb_n[axis]; }>(truth, t_us);
}
template <int axis>
constexpr auto rate = flown<[](const world::Truth& at) { return at.omega_ib_b[axis]; }>;
template <int axis>
constexpr auto force = flown<[](const world::Truth& at) { return at.f_ib_b[axis]; }>;
template <int axis>
constexpr auto wind = glided<[](const world::GlideTruth& at) { return at.wind_n[axis]; }>;

constexpr std::array known{
    Truthed{&quantities::attitude_roll, "rad", true, attitude<&world::Euler::roll>},
    Truthed{&quantities::attitude_pitch, "rad", true, attitude<&world::Euler::pitch>},
    Truthed{&quantities::attitude_heading, "rad", true, attitude<&world::Euler::heading>},
    Truthed{&quantities::velocity_north, "m/s", false, velocity<0>},
    Truthed{&quantities::velocity_east, "m/s", false, velocity<1>},
    Truthed{&quantities::velocity_down, "m/s", false, velocity<2>},
    Truthed{&quantities::position_latitude, "rad", false,
            flown<[](const world::Truth& at) { return at.position.latitude; }>},
    Truthed{&quantities::position_longitude, "rad", true,
            flown<[](const world::Truth& at) { return at.position.longitude; }>},
    Truthed{&quantities::position_height, "m", false,
            flown<[](const world::Truth& at) { return at.position.height; }>},
    Truthed{&quantities::rate_x, "rad/s", false, rate<0>},
    Truthed{&quantities::rate_y, "rad/s", false, rate<1>},
    Truthed{&quantities::rate_z, "rad/s", false, rate<2>},
    Truthed{&quantities::specific_force_x, "m/s^2", false, force<0>},
    Truthed{&quantities::specific_force_y, "m/s^2", false, force<1>},
    Truthed{&quantities::specific_force_z, "m/s^2", false, force<2>},
    Truthed{&quantities::los_rate_pitch, "rad/s", false,
            engaged<[](const world::EngagementTruth& at) { return at.los_rate.pitch; }>},
    Truthed{&quantities::los_rate_yaw, "rad/s", false,
            engaged<[](const world::EngagementTruth& at) { return at.los_rate.yaw; }>},
    Truthed{&quantities::wind_north, "m/s", false, wind<0>},
    Truthed{&quantities::wind_east, "m/s", false, wind<1>},
    Truthed{&quantities::wind_down, "m/s", false, wind<2>},
};

}  // namespace

std::span<const Truthed> truths() { return known; }

const Truthed* find_truth(std::string_view quantity) {
  const auto found =
      std::ranges::find(known, quantity, [](const Truthed& one) { return one.quantity->name; });
  return found == known.end() ? nullptr : &*found;
}

}  // namespace canhil::mapping
