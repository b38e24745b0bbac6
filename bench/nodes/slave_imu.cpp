#include "bench/nodes/slave_imu.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "bench/nodes/increment_rounding.hpp"
#include "bench/nodes/sampler.hpp"
#include "bench/nodes/wire_limits.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::nodes {
namespace {

using messages::SlaveImuDeltaTheta;
using messages::SlaveImuDeltaV;
using messages::SlaveImuStatus;
using messages::Validity;

constexpr std::int8_t temperature_degc = 25;  // the error model has no temperature
constexpr std::array<scenario::Assumed, 1> assumed{{{"temperature_degc", temperature_degc}}};
constexpr std::array<scenario::Increment, 6> increments{
    {{"delta_theta_x_rad", "rate_x_radps", "imu.rate.x"},
     {"delta_theta_y_rad", "rate_y_radps", "imu.rate.y"},
     {"delta_theta_z_rad", "rate_z_radps", "imu.rate.z"},
     {"delta_v_x_mps", "specific_force_x_mps2", "imu.specific_force.x"},
     {"delta_v_y_mps", "specific_force_y_mps2", "imu.specific_force.y"},
     {"delta_v_z_mps", "specific_force_z_mps2", "imu.specific_force.z"}}};

NodeSettings read(const NodeTable& table, Section& section) {
  const Limits sigma = Limits::at_least(0);
  SlaveImuSettings node;
  node.schedule = read_schedule(section);
  node.errors.gyro = {
      .bias = {.value = section.three({"gyro_bias_degph", "Constant bias of the gyros, [x, y, z]."}),
               .sigma = section.three(
                   {"gyro_bias_sigma_degph", "1-sigma of the bias of the gyros, drawn for each run."},
                   sigma)},
      .noise = section.three({"gyro_noise_degprth", "Density of the white noise of the gyros."}, sigma),
      .scale_factor = {.value = section.three(
                           {"gyro_scale_factor_ppm", "Constant scale factor error of the gyros."}),
                       .sigma = section.three(
                           {"gyro_scale_factor_sigma_ppm",
                            "1-sigma of the scale factor error of the gyros, drawn for each run."},
                           sigma)},
      .misalignment_sigma = section.number(
          {"gyro_misalignment_sigma_mrad", "1-sigma of each misalignment of the gyros, drawn for each run."},
          sigma, 0)};
  node.errors.accel = {
      .bias = {.value = section.three({"accel_bias_ug", "Constant bias of the accelerometers, [x, y, z]."}),
               .sigma = section.three(
                   {"accel_bias_sigma_ug", "1-sigma of the bias of the accelerometers, drawn for each run."},
                   sigma)},
      .noise =
          section.three({"accel_noise_ugprthz", "Density of the white noise of the accelerometers."}, sigma),
      .scale_factor = {.value = section.three(
                           {"accel_scale_factor_ppm", "Constant scale factor error of the accelerometers."}),
                       .sigma = section.three(
                           {"accel_scale_factor_sigma_ppm",
                            "1-sigma of the scale factor error of the accelerometers, drawn for each run."},
                           sigma)},
      .misalignment_sigma =
          section.number({"accel_misalignment_sigma_mrad",
                          "1-sigma of each misalignment of the accelerometers, drawn for each run."},
                         sigma, 0)};
  node.loss_probability = section.number(
      {"loss_percent", "Share of the sample groups that are not sent. Their increments are lost."},
      Limits::between(0, 100), 0);
  return {table, node};
}

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

Result<void> fits(const NodeSettings& node, const scenario::Scenario& /*scenario*/,
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

class SlaveImu final : public Sampler<SlaveImuSettings> {
 public:
  SlaveImu(const NodeSettings& node, const Run& run)
      : Sampler(node, run),
        imu_(config_.errors, run.stream("slave_imu")),
        losses_(run.stream("slave_imu.loss")),
        theta_rounding_(SlaveImuDeltaTheta::signals()[0]),
        velocity_rounding_(SlaveImuDeltaV::signals()[0]) {}

 private:
  bool sample(std::int64_t /*t_us*/, Transmission& out) override {
    const world::ImuIncrement measured = imu_.measure(run_.flight.increments()[next_++]);
    const world::Vector3 delta_theta = theta_rounding_.round(measured.delta_theta, out.rounding());
    const world::Vector3 delta_v = velocity_rounding_.round(measured.delta_v, out.rounding());
    out.send(SlaveImuDeltaTheta{.delta_theta_x_rad = delta_theta.x(),
                                .delta_theta_y_rad = delta_theta.y(),
                                .delta_theta_z_rad = delta_theta.z(),
                                .gyro_validity = Validity::valid});
    out.send(SlaveImuDeltaV{.delta_v_x_mps = delta_v.x(),
                            .delta_v_y_mps = delta_v.y(),
                            .delta_v_z_mps = delta_v.z(),
                            .accel_validity = Validity::valid});
    out.send(SlaveImuStatus{.time_of_validity_us = wrap_us(measured.t_us),
                            .interval_us = static_cast<double>(measured.interval_us),
                            .temperature_degc = temperature_degc});
    return losses_.uniform() >= config_.loss_probability;
  }

  world::ErroneousImu imu_;
  world::Stream losses_;  // a separate stream: losses do not change measurements
  std::size_t next_ = 0;
  IncrementRounding theta_rounding_;
  IncrementRounding velocity_rounding_;
};

}  // namespace

constinit const Kind slave_imu{.table = {.key = "slave_imu",
                                         .closes = messages::SlaveImuStatus::info,
                                         .samples = scenario::TruthOf::navigation,
                                         .read = read,
                                         .assumed = assumed,
                                         .increments = increments},
                               .make = make<SlaveImu>,
                               .fits = fits,
                               .at_every_epoch = true};

}  // namespace canhil::nodes
