// Plays the bench for tests of the LOS rate: the seeker of a missile on its way to the target.
#pragma once

#include <functional>
#include <vector>

#include "tests/unit/target/device/bench_side.hpp"
#include "tests/unit/target/estimators/los_rate/engagement.hpp"

namespace canhil::target {

/// The messages of one sample group `Seeker`.
struct SeekerSample {
  messages::SeekerAntenna antenna;
  messages::SeekerAngles angles;
  messages::SeekerMotion motion;
  messages::SeekerRange range;
};

/// Flies los_rate::Engagement at the seeker's rate with a Sync before each group.
class Missile : public BenchSide {
 public:
  static constexpr std::int64_t period_us = 5'000;

  explicit Missile(messages::Algorithm algorithm = messages::Algorithm::combined,
                   const std::vector<messages::ParamSet>& parameters = {},
                   const los_rate::EngagementSetup& setup = rolling())
      : engagement_(setup) {
    command(messages::Command::reset, messages::Estimator::los_rate, algorithm);
    for (const auto& parameter : parameters) send(parameter);
    initialise();
    command(messages::Command::start, messages::Estimator::los_rate, algorithm);
  }
  static los_rate::EngagementSetup rolling() {
    los_rate::EngagementSetup setup;
    setup.roll_rate = 0.5;
    setup.target = {30, -20};
    return setup;
  }

  /// The next sample, with the signals of the DBC: acceleration along antenna y is in the plane of yaw.
  SeekerSample next() {
    using messages::Validity;
    const los_rate::Measurement m = engagement_.next();
    t_us_ += period_us;
    return {.antenna = {.antenna_increment_roll_rad = m.roll_increment,
                        .antenna_increment_pitch_rad = m.antenna_increment.pitch,
                        .antenna_increment_yaw_rad = m.antenna_increment.yaw,
                        .antenna_validity = Validity::valid},
            .angles = {.error_pitch_rad = m.error.pitch,
                       .error_yaw_rad = m.error.yaw,
                       .interval_us = period_us,
                       .error_validity = Validity::valid},
            .motion = {.missile_acceleration_y_mps2 = m.missile_acceleration.yaw,
                       .missile_acceleration_z_mps2 = m.missile_acceleration.pitch,
                       .closing_speed_mps = m.range.closing_speed,
                       .acceleration_validity = Validity::valid,
                       .closing_speed_validity = Validity::valid},
            .range = {.range_m = m.range.range,
                      .time_of_validity_us = wrap_us(t_us_),
                      .range_validity = Validity::valid}};
  }
  void transmit(const SeekerSample& sample) {
    send(sample.antenna);
    send(sample.angles);
    send(sample.motion);
    send(sample.range);
  }
  /// Sends the next group after `spoil` has changed it.
  void fly(const std::function<void(SeekerSample&)>& spoil = [](SeekerSample&) {}) {
    SeekerSample sample = next();
    spoil(sample);
    sync(t_us_);
    transmit(sample);
  }
  /// Flies one sample; its group is lost.
  void fly_unheard() {
    const SeekerSample sample = next();
    sync(t_us_);
    lose(sample.antenna);
    lose(sample.angles);
    lose(sample.motion);
    lose(sample.range);
  }
  void fly_until(double time_to_go) {
    while (t_us_ == 0 || truth().time_to_go > time_to_go) fly();  // there is no truth before the first sample
  }

  [[nodiscard]] std::int64_t t_us() const { return t_us_; }
  [[nodiscard]] bool over() const { return engagement_.over(); }
  [[nodiscard]] const los_rate::Truth& truth() const { return engagement_.truth(); }
  [[nodiscard]] messages::LosRateEstimate estimate() const { return *last<messages::LosRateEstimate>(); }
  [[nodiscard]] messages::LosRateSigma sigma() const { return *last<messages::LosRateSigma>(); }
  /// The magnitude of the error of the LOS rate, over both planes [rad/s].
  [[nodiscard]] double rate_error() const {
    const los_rate::Plane rate{estimate().los_rate_yaw_radps, estimate().los_rate_pitch_radps};
    return std::abs(rate - truth().rate);
  }

 private:
  los_rate::Engagement engagement_;
  std::int64_t t_us_ = 0;
};

}  // namespace canhil::target
