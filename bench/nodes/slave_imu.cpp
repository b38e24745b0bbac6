// Whether the increments of the IMU fit into their signals.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "bench/nodes/fits.hpp"
#include "bench/nodes/wire_limits.hpp"
#include "bench/sensors/slave_imu.hpp"
#include "messages/canhil.hpp"

namespace canhil::nodes {
namespace {

using messages::SlaveImuDeltaTheta;
using messages::SlaveImuDeltaV;
using messages::SlaveImuStatus;
using sensors::SlaveImuSettings;

// For each term of parts_of(), in the same order: the name of the setting that causes the term. Error
// messages contain these names.
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

// An upper bound for each term of (I + M) exact + bias dt + noise sqrt(dt). A random term is taken as six
// times its sigma. A row of the matrix M has two misalignments. The sum of their two terms has this sigma:
// the sigma of one misalignment, times the length of the other two components of `exact`.
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

// The first three signals of an increment message are the increments of the axes x, y and z.
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
      return misfit(fmt::format("{} (largest part): an IMU increment of up to",
                                names[static_cast<std::size_t>(largest)]),
                    reach, Message::info, signal);
    }
  }
  return {};
}

}  // namespace

Result<void> slave_imu_fits(const NodeSettings& node, const scenario::Scenario& /*scenario*/,
                            const world::FlightRecord& flight) {
  if (auto checked = check_interval("IMU interval", flight.interval_us(), SlaveImuStatus::info,
                                    SlaveImuStatus::signals());
      !checked)
    return checked;
  const world::ImuErrorModel& imu = node.own<SlaveImuSettings>()->errors;
  std::string wrong =
      check_triad<SlaveImuDeltaTheta>(gyro_parts, imu.gyro, flight, &world::ImuIncrement::delta_theta);
  if (wrong.empty())
    wrong = check_triad<SlaveImuDeltaV>(accel_parts, imu.accel, flight, &world::ImuIncrement::delta_v);
  if (wrong.empty()) return {};
  return failure(std::move(wrong));
}

}  // namespace canhil::nodes
