#include "bench/sensors/seeker.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <deque>
#include <optional>

#include "bench/sensors/constant_error.hpp"
#include "bench/sensors/kind.hpp"
#include "bench/world/plant_record.hpp"

namespace canhil::sensors {
namespace {

constexpr std::uint32_t antenna_flag = 1U << 0U, error_flag = 1U << 1U, acceleration_flag = 1U << 2U,
                        closing_speed_flag = 1U << 3U, range_flag = 1U << 4U;
constexpr std::array<Output, 9> values{
    {{.name = "antenna_increment_roll",
      .si = "rad",
      .flags = antenna_flag,
      .rate = "seeker.antenna_rate.roll",
      .rate_column = "antenna_rate_roll_radps"},
     {.name = "antenna_increment_pitch",
      .si = "rad",
      .flags = antenna_flag,
      .rate = "seeker.antenna_rate.pitch",
      .rate_column = "antenna_rate_pitch_radps"},
     {.name = "antenna_increment_yaw",
      .si = "rad",
      .flags = antenna_flag,
      .rate = "seeker.antenna_rate.yaw",
      .rate_column = "antenna_rate_yaw_radps"},
     {.name = "error_pitch", .si = "rad", .flags = error_flag},
     {.name = "error_yaw", .si = "rad", .flags = error_flag},
     {.name = "missile_acceleration_y", .si = "m/s^2", .flags = acceleration_flag},
     {.name = "missile_acceleration_z", .si = "m/s^2", .flags = acceleration_flag},
     {.name = "closing_speed", .si = "m/s", .flags = closing_speed_flag},
     {.name = "range", .si = "m", .flags = range_flag}}};
constexpr std::array<std::string_view, 5> flags{"antenna", "error", "acceleration", "closing_speed", "range"};
// The detector saturates at this error angle [rad], which is beyond the largest field of view (37 deg). Near
// the flight target, noise may exceed it.
constexpr double largest_error = 0.655;

double detected(double error) { return std::clamp(error, -largest_error, largest_error); }

SeekerErrorModel read_errors(Section& section) {
  const Limits sigma = Limits::at_least(0);
  return {
      .thermal = section.number({"thermal_noise_radpm2",
                                 "Thermal noise of an error angle. The 1-sigma of a sample is this value "
                                 "multiplied by the square of the range."},
                                sigma, 1e-10),
      .glint = section.number(
          {"glint_noise_m",
           "Glint noise of an error angle. The 1-sigma of a sample is this value divided by the range."},
          sigma, 0.5),
      .glint_correlation = section.number(
          {"glint_correlation_ms", "Correlation time of the glint noise; 0: the noise is white."}, sigma, 0),
      .constant = section.number(
          {"constant_noise_mrad", "Range-independent noise of an error angle, 1-sigma of a sample."}, sigma,
          0),
      .gyro_noise =
          section.number({"gyro_noise_mradps", "Noise of the antenna rates, 1-sigma of a sample."}, sigma, 1),
      .gyro_bias = read_constant(section, "gyro_bias_mradps", "the antenna rates", 0.5),
      .accel_noise = section.number(
          {"accel_noise_mps2", "Noise of the missile's acceleration, 1-sigma of a sample."}, sigma, 0.3),
      .accel_bias = read_constant(section, "accel_bias_mps2", "the missile's acceleration", 0.2),
      .range_noise = section.number({"range_noise_m", "Noise of the range, 1-sigma of a sample."}, sigma, 5),
      .range_bias = read_constant(section, "range_bias_m", "the range", 15),
      .full_errors_beyond = section.number(
          {"range_errors_full_beyond_m",
           "Range below which the errors of the measured range become smaller, in proportion to the range."},
          Limits::above(0), 1000),
      .closing_speed_noise = section.number(
          {"closing_speed_noise_mps", "Noise of the closing speed, 1-sigma of a sample."}, sigma, 3),
      .closing_speed_bias = read_constant(section, "closing_speed_bias_mps", "the closing speed", 5),
      .field_of_view = section.number(
          {"field_of_view_deg",
           "Largest angle from the antenna's axis at which the seeker detects the flight target."},
          Limits::above(0, 37), 8)};
}

NodeSettings read(const NodeTable& table, Section& section) {
  const Limits share = Limits::between(0, 100);
  SeekerSettings node;
  node.schedule = read_constant_schedule(section);
  node.jitter_us =
      section.time_us({"jitter_ms", "Each sample is sent later by a random time between 0 and this value."},
                      Limits::between(0, 1000), 0);
  node.errors = read_errors(section);
  node.loss_probability =
      section.number({"loss_percent", "Share of the samples that are not sent."}, share, 0);
  node.invalid_probability =
      section.number({"invalid_percent", "Share of the samples whose angles are invalid."}, share, 0);
  node.invalid_range_probability =
      section.number({"invalid_range_percent", "Share of the samples whose range is invalid."}, share, 0);
  node.blackout_us = section.optional_interval_us(
      {"blackout_s", "Interval in which the seeker does not detect the flight target."}, Limits::at_least(0));
  return {table, node};
}

// In closed loop, the answer to a sample takes effect one guidance delay after the sample was sent, even if
// the answer arrives earlier. So, if the delay is at least one Sync cycle, the flight is the same on every
// bus and every clock.
class Seeker final : public Sensor {
 public:
  Seeker(const NodeSettings& node, const Run& run)
      : run_(run),
        truth_(Columns::find(run.plants, names).value()),
        guidance_(run.scenario.plant_with(node.table().samples)->guidance),
        errors_(node.own<SeekerSettings>()->errors, run.stream("seeker")),
        config_(*node.own<SeekerSettings>()),
        faults_(run.stream("seeker.faults")),
        period_us_(node.period_us()) {
    advance();
  }

  [[nodiscard]] std::int64_t due_us() const override {
    return over_ || due_us_ > run_.flight.end_us() ? never_us : due_us_;
  }
  Sample measure() override;
  [[nodiscard]] bool is_guided() const override { return guidance_.has_value(); }
  void guide(const Guidance& answer) override;

 private:
  /// A sample whose answer may still arrive.
  struct Sent {
    std::int64_t valid_us = 0;
    std::int64_t sent_us = 0;
    world::Matrix3 C_na;                  ///< transforms from antenna axes to axes that do not rotate
    double range = 0, closing_speed = 0;  ///< as measured [m], [m/s]
    world::Planes<double> missile_acceleration{};  ///< as measured [m/s^2]
  };

  // In the order of Columns::Names.
  enum : std::size_t {
    range,
    closing_speed,
    error_pitch,
    error_yaw,
    q_w,
    q_x,
    q_y,
    q_z,
    roll,
    pitch,
    yaw,
    v_y,
    v_z
  };
  using Columns = world::PlantColumns<13>;
  static constexpr Columns::Names names{"plant.range",
                                        "plant.closing_speed",
                                        "plant.error.pitch",
                                        "plant.error.yaw",
                                        "plant.antenna.w",
                                        "plant.antenna.x",
                                        "plant.antenna.y",
                                        "plant.antenna.z",
                                        "plant.antenna_increment.roll",
                                        "plant.antenna_increment.pitch",
                                        "plant.antenna_increment.yaw",
                                        "plant.velocity_increment.y",
                                        "plant.velocity_increment.z"};

  [[nodiscard]] std::optional<SeekerTruth> truth() const;
  Sample sampled(const SeekerMeasurement& measured);
  void advance();
  [[nodiscard]] static world::Vector3 rate_at_use(const Sent& sample, const Guidance& answer, double dt);

  Run run_;
  Columns truth_;
  std::optional<scenario::Guidance> guidance_;  // none: the answers guide nothing
  ErroneousSeeker errors_;
  SeekerSettings config_;
  world::Stream faults_;  // separate from the measurements, which losses and jitter must not change
  bool over_ = false;     // after the closest approach there is nothing to see
  std::int64_t period_us_;
  std::int64_t valid_us_ = 0;
  std::int64_t due_us_ = 0;
  std::deque<Sent> sent_;
};

// Keeps the order of the samples in spite of the jitter.
void Seeker::advance() {
  valid_us_ += period_us_;
  const double jitter_us = faults_.uniform() * static_cast<double>(config_.jitter_us);
  due_us_ = std::max(due_us_, valid_us_ + config_.schedule.latency_us + static_cast<std::int64_t>(jitter_us));
}

// Increments are those of each step of the plant: a sample has the sum over its period.
std::optional<SeekerTruth> Seeker::truth() const {
  const world::PlantRecord& record = truth_.record();
  const auto row = record.row(valid_us_);
  if (!row || (record.ended_us && *record.ended_us <= valid_us_)) return std::nullopt;
  auto now = truth_.of_row(*row);
  for (std::size_t i = *row; i-- > 0 && record.times_us()[i] > valid_us_ - period_us_;) {
    const auto before = truth_.of_row(i);
    for (std::size_t value = roll; value <= v_z; ++value) now[value] += before[value];
  }
  const double dt = 1e-6 * static_cast<double>(period_us_);
  return SeekerTruth{.t_us = valid_us_,
                     .interval_us = period_us_,
                     .range = now[range],
                     .closing_speed = now[closing_speed],
                     .error = {.pitch = now[error_pitch], .yaw = now[error_yaw]},
                     .delta_theta = {now[roll], now[pitch], now[yaw]},
                     .mean_acceleration = world::Vector3(0, now[v_y], now[v_z]) / dt};
}

Sample Seeker::measure() {
  const auto now = truth();
  if (!now) {
    over_ = true;
    return {.fate = Sample::Fate::none};
  }
  const SeekerMeasurement measured = errors_.measure(*now);
  const Sample sample = sampled(measured);
  if (guidance_) {
    const auto at = *truth_.at(valid_us_);
    sent_.push_back({.valid_us = valid_us_,
                     .sent_us = due_us_,
                     .C_na = Eigen::Quaterniond(at[q_w], at[q_x], at[q_y], at[q_z]).toRotationMatrix(),
                     .range = measured.range,
                     .closing_speed = measured.closing_speed,
                     .missile_acceleration = measured.missile_acceleration});
  }
  advance();
  return sample;
}

// An invalid sample has no angle, no range, no closing speed.
Sample Seeker::sampled(const SeekerMeasurement& measured) {
  const bool lost = faults_.uniform() < config_.loss_probability;
  const bool invalid = faults_.uniform() < config_.invalid_probability;
  const bool range_invalid = faults_.uniform() < config_.invalid_range_probability;
  const auto& blackout = config_.blackout_us;
  const bool black = blackout && measured.t_us >= blackout->first && measured.t_us <= blackout->second;
  const bool seen = measured.in_view && !invalid && !black;
  return {.valid_us = measured.t_us,
          .stamp_us = measured.t_us,
          .interval_us = static_cast<double>(measured.interval_us),
          .values = {measured.antenna.x(), measured.antenna.y(), measured.antenna.z(),
                     seen ? detected(measured.error.pitch) : 0, seen ? detected(measured.error.yaw) : 0,
                     measured.missile_acceleration.yaw, measured.missile_acceleration.pitch,
                     range_invalid ? 0 : measured.closing_speed, range_invalid ? 0 : measured.range},
          .invalid = (seen ? 0 : error_flag) | (range_invalid ? closing_speed_flag | range_flag : 0),
          .fate = lost ? Sample::Fate::lost : Sample::Fate::sent};
}

// Extrapolates the estimated LOS rate from the time of the sample over the time dt to the time of use. The
// time derivative of the LOS rate w is (2 vc / r) w + (a - a_m) / r, see Na and Lee, eq. (1). The range is r
// and decreases with the closing speed vc; a is the estimated acceleration of the target, and a_m is the
// acceleration that the missile measured. vc, a and a_m are taken as constant. The extrapolation ends where
// the range has halved, because the rate grows without bound. The result is in the axes of the antenna at the
// time of the sample.
world::Vector3 Seeker::rate_at_use(const Sent& sample, const Guidance& answer, double dt) {
  const double r0 = sample.range;
  if (sample.closing_speed * dt > r0 / 2) dt = r0 / (2 * sample.closing_speed);
  const double r = r0 - sample.closing_speed * dt;
  const double w = r0 * r0 / (r * r), a = dt * (r0 + r) / (2 * r * r);
  return {0, w * answer.los_rate.pitch - a * (answer.acceleration.pitch - sample.missile_acceleration.pitch),
          w * answer.los_rate.yaw + a * (answer.acceleration.yaw - sample.missile_acceleration.yaw)};
}

// Commands the guidance with the answer's LOS rate. The antenna's axes and the closing speed are those of the
// sample that the answer responds to.
void Seeker::guide(const Guidance& answer) {
  while (!sent_.empty() && sent_.front().valid_us < answer.cause_us) sent_.pop_front();
  if (sent_.empty() || sent_.front().valid_us != answer.cause_us) return;
  const Sent& sample = sent_.front();
  const std::int64_t use_us = sample.sent_us + guidance_->delay_us;
  const std::int64_t half_period_us = period_us_ / 2;
  const double age = 1e-6 * static_cast<double>(use_us - answer.cause_us + half_period_us);
  const world::Vector3 omega_los_a = guidance_->predicts && sample.range > 0
                                         ? rate_at_use(sample, answer, age)
                                         : world::Vector3(0, answer.los_rate.pitch, answer.los_rate.yaw);
  const world::Vector3 omega_los_n = sample.C_na * omega_los_a;
  run_.guide(use_us, std::array{omega_los_n.x(), omega_los_n.y(), omega_los_n.z(), sample.closing_speed});
}

std::vector<Stated> data_sheet(const NodeSettings& node) {
  const RandomValue& bias = node.own<SeekerSettings>()->errors.gyro_bias;
  return {{"antenna_rate_bias_sigma_radps", std::hypot(bias.value, bias.sigma)}};
}

}  // namespace

constinit const Kind seeker{.key = "seeker",
                            .samples = "plant.range",
                            .read = read,
                            .make = make<Seeker>,
                            .outputs = {.values = values, .flags = flags},
                            .data_sheet = data_sheet};

}  // namespace canhil::sensors
