#include "bench/sensors/slave_imu.hpp"

#include <array>

#include "bench/sensors/constant_error.hpp"
#include "bench/sensors/sampler.hpp"

namespace canhil::sensors {
namespace {

constexpr double temperature_degc = 25;  // the error model has no temperature
constexpr std::uint32_t gyro_flag = 1U << 0U, accel_flag = 1U << 1U;
constexpr std::array<Output, 7> values{
    {{.name = "delta_theta_x",
      .si = "rad",
      .flags = gyro_flag,
      .rate = "imu.rate.x",
      .rate_column = "rate_x_radps"},
     {.name = "delta_theta_y",
      .si = "rad",
      .flags = gyro_flag,
      .rate = "imu.rate.y",
      .rate_column = "rate_y_radps"},
     {.name = "delta_theta_z",
      .si = "rad",
      .flags = gyro_flag,
      .rate = "imu.rate.z",
      .rate_column = "rate_z_radps"},
     {.name = "delta_v_x",
      .si = "m/s",
      .flags = accel_flag,
      .rate = "imu.specific_force.x",
      .rate_column = "specific_force_x_mps2"},
     {.name = "delta_v_y",
      .si = "m/s",
      .flags = accel_flag,
      .rate = "imu.specific_force.y",
      .rate_column = "specific_force_y_mps2"},
     {.name = "delta_v_z",
      .si = "m/s",
      .flags = accel_flag,
      .rate = "imu.specific_force.z",
      .rate_column = "specific_force_z_mps2"},
     {.name = "temperature", .flags = gyro_flag | accel_flag, .assumed = temperature_degc}}};
constexpr std::array<std::string_view, 2> flags{"gyro", "accel"};
NodeSettings read(const NodeTable& table, Section& section) {
  const Limits sigma = Limits::at_least(0);
  SlaveImuSettings node;
  node.schedule = read_schedule(section);
  node.errors.gyro = {
      .bias = read_constants(section, "gyro_bias_degph", "the gyros, [x, y, z]"),
      .noise = section.three({"gyro_noise_degprth", "Density of the white noise of the gyros."}, sigma),
      .scale_factor = read_constants(section, "gyro_scale_factor_ppm", "the scale factor of the gyros"),
      .misalignment_sigma = section.number(
          {"gyro_misalignment_sigma_mrad", "1-sigma of each misalignment of the gyros, drawn for each run."},
          sigma, 0)};
  node.errors.accel = {
      .bias = read_constants(section, "accel_bias_ug", "the accelerometers, [x, y, z]"),
      .noise =
          section.three({"accel_noise_ugprthz", "Density of the white noise of the accelerometers."}, sigma),
      .scale_factor =
          read_constants(section, "accel_scale_factor_ppm", "the scale factor of the accelerometers"),
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
        epochs_(node.period_us() / run.flight.interval_us()),
        imu_(config_.errors, run.stream("slave_imu")),
        losses_(run.stream("slave_imu.loss")) {}

 private:
  bool take(std::int64_t /*t_us*/, Sample& sample) override {
    world::ImuIncrement exact = run_.flight.increments()[next_++];
    for (std::int64_t more = 1; more < epochs_; ++more) {
      const world::ImuIncrement& then = run_.flight.increments()[next_++];
      exact.t_us = then.t_us;
      exact.interval_us += then.interval_us;
      exact.delta_theta += then.delta_theta;
      exact.delta_v += then.delta_v;
    }
    const world::ImuIncrement measured = imu_.measure(exact);
    sample.stamp_us = measured.t_us;
    sample.interval_us = static_cast<double>(measured.interval_us);
    const world::Vector3 &theta = measured.delta_theta, &v = measured.delta_v;
    sample.values = {theta.x(), theta.y(), theta.z(), v.x(), v.y(), v.z(), temperature_degc};
    return losses_.uniform() >= config_.loss_probability;
  }

  std::int64_t epochs_;  // of the flight record in a sample; more than 1 beside a faster IMU
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
                               .at_every_epoch = true};

}  // namespace canhil::sensors
