#include "bench/run/wire_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <numeric>

namespace canhil::run {
namespace {

std::string complaint(std::string_view what, double value, const MessageInfo& message,
                      const SignalInfo& signal) {
  return fmt::format("{} {:g} {} does not fit into {}.{}, expected {:g} to {:g} in steps of {:g}", what,
                     value, signal.unit, message.name, signal.name, signal.minimum, signal.maximum,
                     wire::lsb(signal));
}

template <class Message>
void check(const Message& message, std::string& wrong) {
  Message::visit(message, [&](const SignalInfo& signal, const auto& member) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(member)>, double>) {
      const bool inside = member >= signal.minimum && member <= signal.maximum;
      const bool vanishes =
          signal.minimum >= 0 && signal.offset == 0 && member != 0 && member < wire::lsb(signal);
      if (wrong.empty() && (!inside || vanishes))
        wrong = complaint("initial value", member, Message::info, signal);
    }
  });
}

// The interval that a message tells: its one signal of that name, in whole steps.
template <class Message>
Result<void> check_interval(std::string_view what, std::int64_t interval_us) {
  const auto interval = static_cast<double>(interval_us);
  for (const SignalInfo& signal : Message::signals()) {
    if (signal.name != "interval_us") continue;
    const double lsb = wire::lsb(signal);
    const bool between_steps = lsb != 0 && interval / lsb != std::nearbyint(interval / lsb);
    if (interval > signal.maximum || between_steps)
      return failure(complaint(what, interval, Message::info, signal));
  }
  return {};
}

// What a sample of one axis is made of, in the order of `parts_of`: names for messages.
using Names = std::array<std::string_view, 7>;
constexpr Names gyro_parts{"the flight",
                           "'slave_imu.gyro_bias_degph'",
                           "'slave_imu.gyro_bias_sigma_degph'",
                           "'slave_imu.gyro_noise_degprth'",
                           "'slave_imu.gyro_scale_factor_ppm'",
                           "'slave_imu.gyro_scale_factor_sigma_ppm'",
                           "'slave_imu.gyro_misalignment_sigma_mrad'"};
constexpr Names accel_parts{"the flight",
                            "'slave_imu.accel_bias_ug'",
                            "'slave_imu.accel_bias_sigma_ug'",
                            "'slave_imu.accel_noise_ugprthz'",
                            "'slave_imu.accel_scale_factor_ppm'",
                            "'slave_imu.accel_scale_factor_sigma_ppm'",
                            "'slave_imu.accel_misalignment_sigma_mrad'"};

// Bounds of the terms of (I + M) exact + bias dt + noise sqrt(dt), random ones at six sigma. A row of M has
// two misalignments: the sigma of their sum is that of one, times the length of the other two components.
std::array<double, 7> parts_of(const world::TriadErrorModel& model, const world::Vector3& exact, int axis,
                               double dt) {
  constexpr double certain = 6;
  const double along = std::abs(exact[axis]);
  const double across = std::sqrt(std::max(0.0, exact.squaredNorm() - along * along));
  return {along,
          std::abs(model.bias.value[axis]) * dt,
          certain * model.bias.sigma[axis] * dt,
          certain * model.noise[axis] * std::sqrt(dt),
          std::abs(model.scale_factor.value[axis]) * along,
          certain * model.scale_factor.sigma[axis] * along,
          certain * model.misalignment_sigma * across};
}

// The first three signals of a message of increments are its axes.
template <class Message>
std::string check_triad(const Names& names, const world::TriadErrorModel& model,
                        const world::FlightRecord& truth, world::Vector3 world::ImuIncrement::*delta) {
  const double dt = 1e-6 * static_cast<double>(truth.interval_us());
  for (const world::ImuIncrement& exact : truth.increments()) {
    for (int axis = 0; axis < 3; ++axis) {
      const SignalInfo& signal = Message::signals()[static_cast<std::size_t>(axis)];
      const auto parts = parts_of(model, exact.*delta, axis, dt);
      const double reach = std::reduce(parts.begin(), parts.end());
      if (reach <= std::min(-signal.minimum, signal.maximum)) continue;
      const auto largest = std::ranges::max_element(parts) - parts.begin();
      return complaint(fmt::format("{} (largest part): an IMU increment of up to",
                                   names[static_cast<std::size_t>(largest)]),
                       reach, Message::info, signal);
    }
  }
  return {};
}

}  // namespace

Result<void> check_fits(const InitialState& state) {
  std::string wrong;
  const auto check_all = [&](const auto&... messages) { (check(messages, wrong), ...); };
  if (state.air) std::apply(check_all, *state.air);
  std::apply(check_all, state.navigation);
  if (wrong.empty()) return {};
  return failure(std::move(wrong));
}

Result<void> check_fits_imu_interval(std::int64_t interval_us) {
  return check_interval<messages::SlaveImuStatus>("IMU interval", interval_us);
}

Result<void> check_fits(const world::EngagementPlan& engagement, const scenario::Seeker& seeker) {
  using messages::SeekerAntenna;
  const std::int64_t interval_us =
      seeker.schedule.period_us.value_or(messages::SeekerRange::info.cycle_time_us);
  if (auto fits =
          check_interval<messages::SeekerAngles>("key 'seeker.period_ms': seeker interval", interval_us);
      !fits)
    return fits;
  const double roll = std::abs(engagement.roll_rate) * 1e-6 * static_cast<double>(interval_us);
  const SignalInfo& signal = SeekerAntenna::signals()[0];
  if (roll > signal.maximum) return failure(complaint("roll increment", roll, SeekerAntenna::info, signal));
  const std::int64_t least_us = messages::Sync::info.cycle_time_us;
  if (engagement.guidance == world::Guidance::target && engagement.guidance_delay_us < least_us) {
    return failure(fmt::format(
        "key 'engagement.guidance_delay_ms': {:g} is less than the bus takes in "
        "lockstep, expected at least {:g}, the cycle of Sync",
        1e-3 * static_cast<double>(engagement.guidance_delay_us), 1e-3 * static_cast<double>(least_us)));
  }
  return {};
}

Result<void> check_fits(const world::ImuErrorModel& imu, const world::FlightRecord& truth) {
  std::string wrong = check_triad<messages::SlaveImuDeltaTheta>(gyro_parts, imu.gyro, truth,
                                                                &world::ImuIncrement::delta_theta);
  if (wrong.empty())
    wrong =
        check_triad<messages::SlaveImuDeltaV>(accel_parts, imu.accel, truth, &world::ImuIncrement::delta_v);
  if (wrong.empty()) return {};
  return failure(std::move(wrong));
}

}  // namespace canhil::run
