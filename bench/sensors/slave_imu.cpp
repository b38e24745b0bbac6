#include "bench/sensors/slave_imu.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <tuple>

#include "bench/sensors/constant_error.hpp"
#include "bench/sensors/error_stack.hpp"
#include "bench/sensors/sampler.hpp"
#include "bench/world/mounting.hpp"
#include "bench/world/units.hpp"

namespace canhil::sensors {
namespace {

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
     {.name = "temperature", .flags = gyro_flag | accel_flag, .assumed = world::WarmUp::room}}};
constexpr std::array<std::string_view, 2> flags{"gyro", "accel"};
// The keys of the gyros or of the accelerometers.
struct TriadKeys {
  std::string_view of;
  std::string_view bias, bias_per_k, bias_per_k2, noise, scale_factor, scale_per_k, misalignment,
      nonorthogonality;
  StackKeys stack;
};
constexpr TriadKeys gyro_keys{.of = "the gyros",
                              .bias = "gyro_bias_degph",
                              .bias_per_k = "gyro_bias_degph_per_k",
                              .bias_per_k2 = "gyro_bias_degph_per_k2",
                              .noise = "gyro_noise_degprth",
                              .scale_factor = "gyro_scale_factor_ppm",
                              .scale_per_k = "gyro_scale_factor_ppm_per_k",
                              .misalignment = "gyro_misalignment_sigma_mrad",
                              .nonorthogonality = "gyro_nonorthogonality_mrad",
                              .stack = {.of = "the gyros",
                                        .bandwidth = "gyro_bandwidth_hz",
                                        .order = "gyro_filter_order",
                                        .instability = "gyro_bias_instability_degph",
                                        .correlation = "gyro_bias_correlation_s",
                                        .walk = "gyro_rate_random_walk_degphprth",
                                        .range = "gyro_range_degps",
                                        .step = "gyro_step_degps",
                                        .pulse = "gyro_pulse_urad"}};
constexpr TriadKeys accel_keys{.of = "the accelerometers",
                               .bias = "accel_bias_ug",
                               .bias_per_k = "accel_bias_ug_per_k",
                               .bias_per_k2 = "accel_bias_ug_per_k2",
                               .noise = "accel_noise_ugprthz",
                               .scale_factor = "accel_scale_factor_ppm",
                               .scale_per_k = "accel_scale_factor_ppm_per_k",
                               .misalignment = "accel_misalignment_sigma_mrad",
                               .nonorthogonality = "accel_nonorthogonality_mrad",
                               .stack = {.of = "the accelerometers",
                                         .bandwidth = "accel_bandwidth_hz",
                                         .order = "accel_filter_order",
                                         .instability = "accel_bias_instability_ug",
                                         .correlation = "accel_bias_correlation_s",
                                         .walk = "accel_random_walk_ugprth",
                                         .range = "accel_range_g",
                                         .step = "accel_step_ug",
                                         .pulse = "accel_pulse_mps"}};

world::TriadErrorModel read_triad(Section& section, const TriadKeys& keys) {
  const auto text = [&](std::string_view pattern) { return fmt::format(fmt::runtime(pattern), keys.of); };
  const std::string
      of_bias = text("{}, [x, y, z]"),
      of_scale = text("the scale factor of {}"), of_noise = text("Density of the white noise of {}."),
      of_misalignment = text("1-sigma of each misalignment of {}, drawn for each run."),
      of_nonorthogonality = text(
          "Non-orthogonality of {}: the angles by which the y axis leans towards x, z towards x, and "
          "z towards y."),
      of_bias_per_k = text("Change of the bias of {} with the temperature."),
      of_bias_per_k2 = text("Change of the bias of {} with the square of the temperature."),
      of_scale_per_k = text("Change of the scale factor of {} with the temperature.");
  return {.bias = read_constants(section, keys.bias, of_bias),
          .noise = section.three({keys.noise, of_noise}, Limits::at_least(0)),
          .scale_factor = read_constants(section, keys.scale_factor, of_scale),
          .misalignment_sigma = section.number({keys.misalignment, of_misalignment}, Limits::at_least(0), 0),
          .nonorthogonality =
              section.three({keys.nonorthogonality, of_nonorthogonality}, Limits::between(-100, 100)),
          .bias_per_k = section.three({keys.bias_per_k, of_bias_per_k}),
          .bias_per_k2 = section.three({keys.bias_per_k2, of_bias_per_k2}),
          .scale_per_k = section.three({keys.scale_per_k, of_scale_per_k}),
          .stacks = read_error_stacks(section, keys.stack)};
}

// The range of the temperature is that of its signal, with which every device can do.
world::WarmUp read_warm_up(Section& section) {
  const Limits temperature = Limits::between(-100, 120);
  world::WarmUp warm_up;
  warm_up.start = section.number({"temperature_degc", "Temperature of the IMU at the start of the run."},
                                 temperature, warm_up.start);
  warm_up.rise = section.number(
      {"warm_up_k",
       "By how much the IMU becomes warmer: T(t) = `temperature_degc` + `warm_up_k` (1 - exp(-t / "
       "`warm_up_time_s`))."},
      Limits::between(-100, 100), warm_up.rise);
  warm_up.time_s =
      section.number({"warm_up_time_s", "Time constant of `warm_up_k`."}, Limits::above(0), warm_up.time_s);
  warm_up.reference =
      section.number({"reference_temperature_degc", "Temperature from which the keys `..._per_k` count."},
                     temperature, warm_up.reference);
  if (const double end = warm_up.start + warm_up.rise; end < temperature.least || end > temperature.most)
    section.reject("warm_up_k", fmt::format("leads to {:g} degC", end),
                   "a temperature from -100 to 120 degC");
  return warm_up;
}

NodeSettings read(const NodeTable& table, Section& section) {
  SlaveImuSettings node;
  node.schedule = read_schedule(section);
  node.lever_arm = read_lever_arm(
      section, "the IMU, whose accelerometers then measure the Euler and the centripetal acceleration too");
  node.errors.mounting = read_mounting(section, "the IMU");
  node.errors.gyro = read_triad(section, gyro_keys);
  node.errors.g_sensitivity = section.three(
      {"gyro_g_sensitivity_degph_per_g", "Rate that a gyro reports per specific force along its axis."});
  node.errors.g_sensitivity_sigma = section.number(
      {"gyro_g_sensitivity_sigma_degph_per_g",
       "1-sigma of a further rate of each gyro per specific force along each axis, drawn for each run."},
      Limits::at_least(0), 0);
  node.errors.accel = read_triad(section, accel_keys);
  node.errors.temperature = read_warm_up(section);
  node.saturated_is_invalid =
      section.flag({"saturated_is_invalid",
                    "`true`: a sample beyond the range of gyros or accelerometers is marked as invalid."});
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
        imu_(config_.errors,
             world::ImuStreams::of("slave_imu", [&](const std::string& name) { return run.stream(name); })),
        losses_(run.stream("slave_imu.loss")) {}

 private:
  bool take(std::int64_t taken_us, Sample& sample) override {
    world::ImuIncrement exact = next_increment();
    for (std::int64_t more = 1; more < epochs_; ++more) {
      const world::ImuIncrement then = next_increment();
      exact.t_us = then.t_us;
      exact.interval_us += then.interval_us;
      exact.delta_theta += then.delta_theta;
      exact.delta_v += then.delta_v;
    }
    if (config_.schedule.jitter > 0) end_at(taken_us, exact);
    const world::ImuIncrement measured = imu_.measure(exact);
    sample.stamp_us = measured.t_us;
    sample.interval_us = static_cast<double>(measured.interval_us);
    const world::Vector3 &theta = measured.delta_theta, &v = measured.delta_v;
    const double temperature = config_.errors.temperature.at(1e-6 * static_cast<double>(measured.t_us));
    sample.values = {theta.x(), theta.y(), theta.z(), v.x(), v.y(), v.z(), temperature};
    if (config_.saturated_is_invalid)
      sample.invalid = (imu_.gyro_saturated() ? gyro_flag : 0) | (imu_.accel_saturated() ? accel_flag : 0);
    return losses_.uniform() >= config_.loss_probability;
  }

  // Moves the end of the interval to `taken_us`, and its begin to the end of the one before. Rate and
  // specific force are taken as constant meanwhile.
  void end_at(std::int64_t taken_us, world::ImuIncrement& increment) {
    const world::Truth& at = run_.flight.epochs()[next_];
    const double later = 1e-6 * static_cast<double>(taken_us - increment.t_us);
    const world::Vector3 theta = later * at.omega_ib_b, v = later * at.f_ib_b;
    increment.delta_theta += theta - theta_taken_;
    increment.delta_v += v - v_taken_;
    theta_taken_ = theta;
    v_taken_ = v;
  }

  world::ImuIncrement next_increment() { return increment_at_imu(config_, run_.flight, next_++); }

  std::int64_t epochs_;  // of the flight record in a sample; more than 1 beside a faster IMU
  world::ErroneousImu imu_;
  world::Stream losses_;  // a separate stream: losses do not change measurements
  std::size_t next_ = 0;
  world::Vector3 theta_taken_ = world::Vector3::Zero();  // beyond the time of validity, by the sample before
  world::Vector3 v_taken_ = world::Vector3::Zero();
};

// 1-sigma of an error that is constant and drawn for each run: the largest of the axes.
double size_of(const world::RandomConstant& error) {
  return (error.value.cwiseAbs2() + error.sigma.cwiseAbs2()).cwiseSqrt().maxCoeff();
}

std::vector<Stated> data_sheet(const NodeSettings& node) {
  const SlaveImuSettings& imu = *node.own<SlaveImuSettings>();
  const auto& [gyro, accel] = std::tie(imu.errors.gyro, imu.errors.accel);
  return {{"gyro_scale_factor_sigma_ppm", size_of(gyro.scale_factor) / world::units::ppm},
          {"gyro_misalignment_sigma_mrad", gyro.misalignment_sigma / world::units::mrad},
          {"accel_scale_factor_sigma_ppm", size_of(accel.scale_factor) / world::units::ppm},
          {"accel_misalignment_sigma_mrad", accel.misalignment_sigma / world::units::mrad},
          {"lever_arm_sigma_m", imu.lever_arm.cwiseAbs().maxCoeff()}};
}

}  // namespace

world::ImuIncrement increment_at_imu(const SlaveImuSettings& settings, const world::FlightRecord& flight,
                                     std::size_t i) {
  const world::ImuIncrement& at_origin = flight.increments()[i];
  if (settings.lever_arm.isZero(0)) return at_origin;
  const world::Vector3 before = flight.epochs()[i].omega_ib_b;
  return increment_at(at_origin, settings.lever_arm, before, flight.epochs()[i + 1].omega_ib_b);
}

constinit const Kind slave_imu{.key = "slave_imu",
                               .read = read,
                               .make = make<SlaveImu>,
                               .outputs = {.values = values, .flags = flags},
                               .at_every_epoch = true,
                               .data_sheet = data_sheet};

}  // namespace canhil::sensors
