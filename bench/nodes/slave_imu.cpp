// Whether the increments of the IMU fit into their signals.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "bench/nodes/fits.hpp"
#include "bench/nodes/wire_limits.hpp"
#include "bench/sensors/slave_imu.hpp"
#include "bench/world/mounting.hpp"
#include "messages/canhil.hpp"

namespace canhil::nodes {
namespace {

using messages::SlaveImuDeltaTheta;
using messages::SlaveImuDeltaV;
using messages::SlaveImuStatus;
using sensors::SlaveImuSettings;

// For each term of parts_of(), in the same order: the name of the setting that causes the term. Error
// messages contain these names.
constexpr std::size_t part_count = 14;
using Names = std::array<std::string_view, part_count>;
constexpr Names gyro_parts{"the flight",
                           "'slave_imu.gyro_bias_degph'",
                           "'slave_imu.gyro_bias_sigma_degph'",
                           "'slave_imu.gyro_noise_degprth'",
                           "'slave_imu.gyro_scale_factor_ppm'",
                           "'slave_imu.gyro_scale_factor_sigma_ppm'",
                           "'slave_imu.gyro_misalignment_sigma_mrad'",
                           "'slave_imu.mounting_sigma_deg'",
                           "'slave_imu.gyro_nonorthogonality_mrad'",
                           "'slave_imu.gyro_bias_instability_degph'",
                           "'slave_imu.gyro_rate_random_walk_degphprth'",
                           "the temperature",
                           "'slave_imu.gyro_g_sensitivity_degph_per_g'",
                           "'slave_imu.gyro_g_sensitivity_sigma_degph_per_g'"};
constexpr Names accel_parts{"the flight",
                            "'slave_imu.accel_bias_ug'",
                            "'slave_imu.accel_bias_sigma_ug'",
                            "'slave_imu.accel_noise_ugprthz'",
                            "'slave_imu.accel_scale_factor_ppm'",
                            "'slave_imu.accel_scale_factor_sigma_ppm'",
                            "'slave_imu.accel_misalignment_sigma_mrad'",
                            "'slave_imu.mounting_sigma_deg'",
                            "'slave_imu.accel_nonorthogonality_mrad'",
                            "'slave_imu.accel_bias_instability_ug'",
                            "'slave_imu.accel_random_walk_ugprth'",
                            "the temperature",
                            "",
                            ""};

// What one triad measures in a sample, and what it has beside its errors.
struct Measured {
  world::Vector3 exact;                                   // increment along the IMU's axes
  world::Vector3 force = world::Vector3::Zero();          // that gyros are sensitive to, its increment
  double mounting_sigma = 0;                              // the largest [rad]
  double warmer = 0;                                      // by so much at most [K]
  world::Vector3 g_sensitivity = world::Vector3::Zero();  // of the gyros
  double g_sensitivity_sigma = 0;
  double dt = 0, run_s = 0;  // of the sample and of the run [s]
};

// An upper bound for each term of (I + M) exact + bias dt + noise sqrt(dt) and of the further errors. A
// random term is taken as six times its sigma. A row of the matrix M has two misalignments. The sum of their
// two terms has this sigma: the sigma of one misalignment, times the length of the other two components of
// `exact`.
std::array<double, part_count> parts_of(const world::TriadErrorModel& model, const Measured& in, int axis) {
  constexpr double certain = 6;
  const double dt = in.dt;
  const double along = std::abs(in.exact[axis]);
  const double across = std::sqrt(std::max(0.0, in.exact.squaredNorm() - along * along));
  const world::ErrorStack& stack = model.stacks[static_cast<std::size_t>(axis)];
  return {
      along,
      std::abs(model.bias.value[axis]) * dt,
      certain * model.bias.sigma[axis] * dt,
      certain * model.noise[axis] * std::sqrt(dt),
      std::abs(model.scale_factor.value[axis]) * along,
      certain * model.scale_factor.sigma[axis] * along,
      certain * model.misalignment_sigma * across,
      certain * in.mounting_sigma * across,
      model.nonorthogonality.norm() * across,
      certain * stack.correlated * dt,
      certain * stack.random_walk * std::sqrt(in.run_s) * dt,
      (std::abs(model.bias_per_k[axis]) + std::abs(model.bias_per_k2[axis]) * in.warmer) * in.warmer * dt +
          std::abs(model.scale_per_k[axis]) * in.warmer * along,
      std::abs(in.g_sensitivity[axis] * in.force[axis]),
      certain * in.g_sensitivity_sigma * in.force.norm()};
}

// The first three signals of an increment message are the increments of the axes x, y and z.
template <class Message>
std::string check_triad(const Names& names, const world::TriadErrorModel& model, const Measured& in) {
  for (int axis = 0; axis < 3; ++axis) {
    const SignalInfo& signal = Message::signals()[static_cast<std::size_t>(axis)];
    const auto parts = parts_of(model, in, axis);
    const double range = model.stacks[static_cast<std::size_t>(axis)].highest * in.dt;
    const double reach = std::min(range, std::reduce(parts.begin(), parts.end()));
    if (reach <= std::min(-signal.minimum, signal.maximum)) continue;
    const auto largest = std::ranges::max_element(parts) - parts.begin();
    return misfit(
        fmt::format("{} (largest part): an IMU increment of up to", names[static_cast<std::size_t>(largest)]),
        reach, Message::info, signal);
  }
  return {};
}

std::string misfit_of(const SlaveImuSettings& settings, const world::FlightRecord& flight) {
  const world::ImuErrorModel& imu = settings.errors;
  const world::Matrix3 C_bs = world::mounted(imu.mounting.value);
  const world::WarmUp& warm_up = imu.temperature;
  Measured gyro{.exact = world::Vector3::Zero(),
                .mounting_sigma = imu.mounting.sigma.maxCoeff(),
                .warmer = std::max(std::abs(warm_up.start - warm_up.reference),
                                   std::abs(warm_up.start + warm_up.rise - warm_up.reference)),
                .g_sensitivity = imu.g_sensitivity,
                .g_sensitivity_sigma = imu.g_sensitivity_sigma,
                .dt = 1e-6 * static_cast<double>(flight.interval_us()),
                .run_s = 1e-6 * static_cast<double>(flight.end_us())};
  Measured accel = gyro;  // accelerometers have no `force`
  for (std::size_t i = 0; i < flight.increments().size(); ++i) {
    const world::ImuIncrement at_imu = increment_at_imu(settings, flight, i);
    gyro.exact = C_bs * at_imu.delta_theta;
    gyro.force = accel.exact = C_bs * at_imu.delta_v;
    std::string wrong = check_triad<SlaveImuDeltaTheta>(gyro_parts, imu.gyro, gyro);
    if (wrong.empty()) wrong = check_triad<SlaveImuDeltaV>(accel_parts, imu.accel, accel);
    if (!wrong.empty()) return wrong;
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
  std::string wrong = misfit_of(*node.own<SlaveImuSettings>(), flight);
  if (wrong.empty()) return {};
  return failure(std::move(wrong));
}

}  // namespace canhil::nodes
