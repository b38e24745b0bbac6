#include "bench/sensors/slave_imu.hpp"

#include <array>

#include "bench/sensors/sampler.hpp"

namespace canhil::sensors {
namespace {

constexpr double temperature_degc = 25;  // the error model has no temperature
constexpr std::array<std::string_view, 7> values{
    "delta_theta_x", "delta_theta_y", "delta_theta_z", "delta_v_x", "delta_v_y", "delta_v_z", "temperature"};
constexpr std::array<std::string_view, 2> flags{"gyro", "accel"};
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

class SlaveImu final : public Sampler<SlaveImuSettings> {
 public:
  SlaveImu(const NodeSettings& node, const Run& run)
      : Sampler(node, run),
        imu_(config_.errors, run.stream("slave_imu")),
        losses_(run.stream("slave_imu.loss")) {}

 private:
  bool take(std::int64_t /*t_us*/, Sample& sample) override {
    const world::ImuIncrement measured = imu_.measure(run_.flight.increments()[next_++]);
    sample.stamp_us = measured.t_us;
    sample.interval_us = measured.interval_us;
    const world::Vector3 &theta = measured.delta_theta, &v = measured.delta_v;
    sample.values = {theta.x(), theta.y(), theta.z(), v.x(), v.y(), v.z(), temperature_degc};
    return losses_.uniform() >= config_.loss_probability;
  }

  world::ErroneousImu imu_;
  world::Stream losses_;  // a separate stream: losses do not change measurements
  std::size_t next_ = 0;
};

}  // namespace

constinit const Kind slave_imu{.key = "slave_imu",
                               .samples = scenario::TruthOf::navigation,
                               .read = read,
                               .make = make<SlaveImu>,
                               .outputs = {.values = values, .flags = flags},
                               .assumed = assumed,
                               .increments = increments,
                               .at_every_epoch = true};

}  // namespace canhil::sensors
