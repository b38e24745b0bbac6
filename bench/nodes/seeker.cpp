#include "bench/nodes/seeker.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <deque>
#include <type_traits>

#include "bench/nodes/increment_rounding.hpp"
#include "bench/nodes/is_whole.hpp"
#include "bench/nodes/kind.hpp"
#include "bench/nodes/wire_limits.hpp"
#include "bench/world/engagement/engagement.hpp"
#include "dbc/wire/sample_group.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::nodes {
namespace {

using namespace messages;

constexpr std::array<scenario::Increment, 3> increments{
    {{"antenna_increment_roll_rad", "antenna_rate_roll_radps", "seeker.antenna_rate.roll"},
     {"antenna_increment_pitch_rad", "antenna_rate_pitch_radps", "seeker.antenna_rate.pitch"},
     {"antenna_increment_yaw_rad", "antenna_rate_yaw_radps", "seeker.antenna_rate.yaw"}}};

constexpr Validity validity(bool valid) { return valid ? Validity::valid : Validity::invalid; }

constexpr bool is_estimate(LosRateOutcome outcome) {
  return outcome == LosRateOutcome::started || outcome == LosRateOutcome::start_up ||
         outcome == LosRateOutcome::updated || outcome == LosRateOutcome::coasting;
}

// Reads two keys. `key` is the constant part of an error. `sigma_key` is the sigma of a further part, which
// is drawn for each run; its name is that of `key` with _sigma before the unit.
world::RandomValue read_constant(Section& section, std::string_view key, std::string_view sigma_key,
                                 std::string_view of, double sigma) {
  return {
      .value = section.number({key, fmt::format("Constant error of {}.", of)}, Limits{}, 0),
      .sigma = section.number(
          {sigma_key,
           fmt::format(
               "1-sigma of a further constant error of {}. This error is drawn for each run and added.", of)},
          Limits::at_least(0), sigma)};
}

world::SeekerErrorModel read_errors(Section& section) {
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
      .gyro_bias =
          read_constant(section, "gyro_bias_mradps", "gyro_bias_sigma_mradps", "the antenna rates", 0.5),
      .accel_noise = section.number(
          {"accel_noise_mps2", "Noise of the missile's acceleration, 1-sigma of a sample."}, sigma, 0.3),
      .accel_bias = read_constant(section, "accel_bias_mps2", "accel_bias_sigma_mps2",
                                  "the missile's acceleration", 0.2),
      .range_noise = section.number({"range_noise_m", "Noise of the range, 1-sigma of a sample."}, sigma, 5),
      .range_bias = read_constant(section, "range_bias_m", "range_bias_sigma_m", "the range", 15),
      .full_errors_beyond = section.number(
          {"range_errors_full_beyond_m",
           "Range below which the errors of the measured range become smaller, in proportion to the range."},
          Limits::above(0), 1000),
      .closing_speed_noise = section.number(
          {"closing_speed_noise_mps", "Noise of the closing speed, 1-sigma of a sample."}, sigma, 3),
      .closing_speed_bias = read_constant(section, "closing_speed_bias_mps", "closing_speed_bias_sigma_mps",
                                          "the closing speed", 5),
      .field_of_view = section.number(
          {"field_of_view_deg",
           "Largest angle from the antenna's axis at which the seeker detects the flight target."},
          Limits::above(0, 37), 8)};
}

NodeSettings read(const NodeTable& table, Section& section) {
  const Limits share = Limits::between(0, 100);
  SeekerSettings node;
  node.schedule = read_schedule(section);
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

Result<void> fits(const NodeSettings& node, const scenario::Scenario& scenario,
                  const world::FlightRecord& /*flight*/) {
  const world::EngagementPlan& engagement = *scenario.engagement;
  const std::int64_t interval_us = node.period_us();
  if (auto checked = check_interval("key 'seeker.period_ms': seeker interval", interval_us,
                                    SeekerAngles::info, SeekerAngles::signals());
      !checked)
    return checked;
  const double roll = std::abs(engagement.roll_rate) * 1e-6 * static_cast<double>(interval_us);
  const SignalInfo& signal = SeekerAntenna::signals()[0];
  if (roll > signal.maximum) return failure(misfit("roll increment", roll, SeekerAntenna::info, signal));
  // In lockstep the bench receives an answer one Sync cycle after it sent the sample.
  const std::int64_t least_us = Sync::info.cycle_time_us;
  if (engagement.guidance == world::Guidance::target && engagement.guidance_delay_us < least_us) {
    return failure(fmt::format(
        "key 'engagement.guidance_delay_ms': {:g} is less than the bus takes in "
        "lockstep, expected at least {:g}, the cycle of Sync",
        1e-3 * static_cast<double>(engagement.guidance_delay_us), 1e-3 * static_cast<double>(least_us)));
  }
  return {};
}

// In closed loop, the answer to a sample takes effect one guidance delay after the sample was sent, even if
// the answer arrives earlier. So, if the delay is at least one Sync cycle, the flight is the same on every
// bus and every clock.
class Seeker final : public Node {
 public:
  Seeker(const NodeSettings& node, const Run& run)
      : run_(run),
        engagement_(*run.scenario.engagement, run.stream("engagement")),
        errors_(node.own<SeekerSettings>()->errors, run.stream("seeker")),
        config_(*node.own<SeekerSettings>()),
        faults_(run.stream("seeker.faults")),
        guided_(run.scenario.engagement->guidance == world::Guidance::target),
        period_us_(node.period_us()),
        rounding_(SeekerAntenna::signals()[0]) {
    advance();
  }

  [[nodiscard]] std::int64_t due_us() const override {
    return engagement_.over() || due_us_ > run_.flight.end_us() ? never_us : due_us_;
  }
  void transmit(Transmission& out) override;
  [[nodiscard]] bool listens() const override { return guided_; }
  void hear(const Frame& frame) override;

 private:
  /// A sample whose answer may still arrive.
  struct Sent {
    std::int64_t valid_us = 0;
    std::int64_t sent_us = 0;
    world::Matrix3 C_na;
    double range = 0, closing_speed = 0;           ///< as measured [m], [m/s]
    world::Planes<double> missile_acceleration{};  ///< as measured [m/s^2]
  };

  void send(Transmission& out, const world::SeekerMeasurement& measured);
  void advance();
  void steer();
  [[nodiscard]] static world::Vector3 rate_at_use(const Sent& sample, const LosRateEstimate& estimate,
                                                  const LosRateTarget& target, double dt);

  Run run_;
  world::Engagement engagement_;
  world::ErroneousSeeker errors_;
  SeekerSettings config_;
  world::Stream faults_;  // separate from the measurements, which losses and jitter must not change
  bool guided_;
  std::int64_t period_us_;
  std::int64_t valid_us_ = 0;
  std::int64_t due_us_ = 0;
  IncrementRounding rounding_;
  std::deque<Sent> sent_;
  SampleGroup<LosRateEstimate, LosRateSigma, LosRateTarget> answer_;
};

// Keeps the order of the samples in spite of the jitter.
void Seeker::advance() {
  valid_us_ += period_us_;
  const double jitter_us = faults_.uniform() * static_cast<double>(config_.jitter_us);
  due_us_ = std::max(due_us_, valid_us_ + config_.schedule.latency_us + static_cast<std::int64_t>(jitter_us));
}

void Seeker::transmit(Transmission& out) {
  engagement_.fly_to(valid_us_);
  const world::SeekerIncrement increment = engagement_.take_increment();
  if (engagement_.over()) {
    run_.engagement->miss_n = engagement_.miss_n();
    run_.engagement->passage_us = engagement_.t_us();
    return;
  }
  const world::EngagementTruth now = engagement_.truth();
  run_.engagement->epochs.push_back(now);
  const world::SeekerMeasurement measured = errors_.measure(now, increment);
  send(out, measured);
  if (guided_) {
    sent_.push_back({.valid_us = valid_us_,
                     .sent_us = due_us_,
                     .C_na = now.C_na,
                     .range = measured.range,
                     .closing_speed = measured.closing_speed,
                     .missile_acceleration = measured.missile_acceleration});
  }
  advance();
}

void Seeker::send(Transmission& out, const world::SeekerMeasurement& measured) {
  const bool lost = faults_.uniform() < config_.loss_probability;
  const bool invalid = faults_.uniform() < config_.invalid_probability;
  const bool range_invalid = faults_.uniform() < config_.invalid_range_probability;
  const auto& blackout = config_.blackout_us;
  const bool black = blackout && measured.t_us >= blackout->first && measured.t_us <= blackout->second;
  const bool seen = measured.in_view && !invalid && !black;
  const world::Vector3 antenna = rounding_.round(measured.antenna, out.rounding());
  out.send(SeekerAntenna{.antenna_increment_roll_rad = antenna.x(),
                         .antenna_increment_pitch_rad = antenna.y(),
                         .antenna_increment_yaw_rad = antenna.z(),
                         .antenna_validity = Validity::valid});
  out.send(SeekerAngles{.error_pitch_rad = seen ? measured.error.pitch : 0,  // an invalid sample has no angle
                        .error_yaw_rad = seen ? measured.error.yaw : 0,
                        .interval_us = static_cast<double>(measured.interval_us),
                        .error_validity = validity(seen)});
  out.send(SeekerMotion{.missile_acceleration_y_mps2 = measured.missile_acceleration.yaw,
                        .missile_acceleration_z_mps2 = measured.missile_acceleration.pitch,
                        .closing_speed_mps = range_invalid ? 0 : measured.closing_speed,
                        .acceleration_validity = Validity::valid,
                        .closing_speed_validity = validity(!range_invalid)});
  out.send(SeekerRange{.range_m = range_invalid ? 0 : measured.range,
                       .time_of_validity_us = wrap_us(measured.t_us),
                       .range_validity = validity(!range_invalid)});
  if (lost) out.clear();  // the counter advances, so the receiver detects the gap
}

void Seeker::hear(const Frame& frame) {
  const auto put = [&]<class Message>(std::type_identity<Message>) {
    if (is_whole<Message>(frame) && answer_.put(from_frame<Message>(frame), e2e::counter(frame.payload())) ==
                                        decltype(answer_)::Outcome::complete) {
      steer();
    }
  };
  put(std::type_identity<LosRateEstimate>{});
  put(std::type_identity<LosRateSigma>{});
  put(std::type_identity<LosRateTarget>{});
}

// Extrapolates the estimated LOS rate from the time of the sample over the time dt to the time of use. The
// time derivative of the LOS rate w is (2 vc / r) w + (a - a_m) / r, see Na and Lee, eq. (1). The range is r
// and decreases with the closing speed vc; a is the estimated acceleration of the target, and a_m is the
// acceleration that the missile measured. vc, a and a_m are taken as constant. The extrapolation ends where
// the range has halved, because the rate grows without bound. The result is in the axes of the antenna at the
// time of the sample.
world::Vector3 Seeker::rate_at_use(const Sent& sample, const LosRateEstimate& estimate,
                                   const LosRateTarget& target, double dt) {
  const double r0 = sample.range;
  if (sample.closing_speed * dt > r0 / 2) dt = r0 / (2 * sample.closing_speed);
  const double r = r0 - sample.closing_speed * dt;
  const double w = r0 * r0 / (r * r), a = dt * (r0 + r) / (2 * r * r);
  return {0,
          w * estimate.los_rate_pitch_radps -
              a * (target.target_acceleration_z_mps2 - sample.missile_acceleration.pitch),
          w * estimate.los_rate_yaw_radps +
              a * (target.target_acceleration_y_mps2 - sample.missile_acceleration.yaw)};
}

// Commands the guidance with the answer's LOS rate. The antenna's axes and the closing speed are those of the
// sample that the answer responds to.
void Seeker::steer() {
  const auto& estimate = answer_.get<LosRateEstimate>();
  const auto& target = answer_.get<LosRateTarget>();
  const world::EngagementPlan& plan = *run_.scenario.engagement;
  const std::int64_t cause_us = unwrap_us(target.cause_time_us, valid_us_);
  while (!sent_.empty() && sent_.front().valid_us < cause_us) sent_.pop_front();
  if (sent_.empty() || sent_.front().valid_us != cause_us) return;
  if (!is_estimate(estimate.outcome) || estimate.blind != 0) return;  // the guidance holds its command
  const Sent& sample = sent_.front();
  const std::int64_t use_us = sample.sent_us + plan.guidance_delay_us;
  const std::int64_t half_period_us = period_us_ / 2;
  const double age = 1e-6 * static_cast<double>(use_us - cause_us + half_period_us);
  const world::Vector3 omega_los_a =
      plan.guidance_predicts && sample.range > 0
          ? rate_at_use(sample, estimate, target, age)
          : world::Vector3(0, estimate.los_rate_pitch_radps, estimate.los_rate_yaw_radps);
  const bool in_time = engagement_.command(use_us, sample.C_na * omega_los_a, sample.closing_speed);
  if (!in_time) ++run_.engagement->late_commands;
}

}  // namespace

constinit const Kind seeker{.table = {.key = "seeker",
                                      .closes = messages::SeekerRange::info,
                                      .samples = scenario::TruthOf::engagement,
                                      .read = read,
                                      .increments = increments},
                            .make = make<Seeker>,
                            .fits = fits};

}  // namespace canhil::nodes
