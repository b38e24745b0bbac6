// The IMU input of an inertial estimator: converts SlaveImu groups to increments without gaps, and sends
// AlignNav or FixNav groups as answers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <optional>

#include "dbc/wire/time_base.hpp"
#include "target/device/adapter.hpp"
#include "target/device/bridging_error.hpp"
#include "target/device/group_intake.hpp"
#include "target/estimators/strapdown/attitude.hpp"
#include "target/estimators/strapdown/imu_increment.hpp"
#include "target/estimators/strapdown/mechanization.hpp"

namespace canhil::target {

/// Ends a run after a numeric error.
inline Health numeric_fault(Context& context) {
  context.errors.numeric = true;
  return Health::fault;
}

/// Passes the three components of an innovation, divided by their sigmas, and the NIS to the monitor.
template <class UpdateResult>
void observe(const UpdateResult& result, ConsistencyMonitor& monitor) {
  const Eigen::Vector3d sigma = result.innovation_covariance.diagonal().cwiseSqrt();
  const Eigen::Vector3d normalised = result.innovation.cwiseQuotient(sigma);
  if constexpr (requires { result.lasting; }) {
    monitor.observe(result.nis, {normalised.data(), 3}, {result.lasting.data(), 3});
  } else {
    monitor.observe(result.nis, {normalised.data(), 3});
  }
}

/// The INS state for an initial state from the bus.
inline strapdown::NavState nav_of(const InitialState& initial) {
  return {.C_bn = strapdown::dcm_from_euler({initial.roll, initial.pitch, initial.heading}),
          .v_eb_n = {initial.v_north, initial.v_east, initial.v_down},
          .latitude = initial.latitude,
          .longitude = initial.longitude,
          .height = initial.height};
}

class ImuStream {
 public:
  void reset() { group_.discard(); }

  /// Starts the INS at t_us. An answer is due at the first sample.
  void start(std::int64_t t_us, std::int64_t output_interval_us) {
    now_us_ = t_us;
    answered_us_ = t_us - output_interval_us;
    previous_ = {};
    bridging_.reset();
    coasting_ = false;
  }

  /// Epoch of the INS.
  [[nodiscard]] std::int64_t now_us() const { return now_us_; }

  /// The counter of the last sample.
  [[nodiscard]] std::uint8_t counter() const { return group_.counter(); }

  /// Returns a fault if the IMU has been silent for too long in the bench's time base.
  Health tick(Context& context) const {
    if (context.now_us - now_us_ <= silence_limit_us) return Health::good;
    context.errors.input_silent = true;
    return Health::fault;
  }

  /// Processes one frame of the IMU. Calls step(increment, t_us) for each increment, also for those that
  /// bridge a gap; t_us is the end of the increment. Then the INS has reached now_us(), and reached() is
  /// called and says how it goes on. A group that is incomplete, invalid or late does not advance the INS; a
  /// gap too long to bridge is a fault. No value: the frame is another sensor's.
  template <class Step, class Reached>
  std::optional<Health> receive(const Frame& frame, std::uint8_t counter, Context& context, const Step& step,
                                const Reached& reached) {
    using namespace messages;
    switch (frame.id) {
      case SlaveImuDeltaTheta::info.id:
        return put<SlaveImuDeltaTheta>(frame, counter, context, step, reached);
      case SlaveImuDeltaV::info.id:
        return put<SlaveImuDeltaV>(frame, counter, context, step, reached);
      case SlaveImuStatus::info.id:
        return put<SlaveImuStatus>(frame, counter, context, step, reached);
      default:
        return std::nullopt;
    }
  }

  /// True if the last sample must be answered. An answer may be up to half an IMU interval early, as the
  /// output interval need not be a multiple of the IMU interval.
  [[nodiscard]] bool answer_is_due(std::int64_t output_interval_us) const {
    return now_us_ - answered_us_ >= output_interval_us - interval_us_ / 2;
  }

  /// Answers the last sample with the estimator's navigation group.
  template <class Attitude, class VelocityNE, class VelocityD>
  void answer(const strapdown::NavState& nav, Answers& answers) {
    constexpr double deg = std::numbers::pi / 180;
    const strapdown::Euler angles = strapdown::euler_from_dcm(nav.C_bn);
    answers.send(Attitude{.roll_deg = angles.roll / deg,
                          .pitch_deg = angles.pitch / deg,
                          .heading_deg = angles.heading / deg,
                          .coasting = static_cast<std::uint8_t>(coasting_)});
    answers.send(VelocityNE{.velocity_north_mps = nav.v_eb_n.x(),
                            .velocity_east_mps = nav.v_eb_n.y(),
                            .cause_counter = group_.counter()});
    answers.send(VelocityD{.velocity_down_mps = nav.v_eb_n.z(), .cause_time_us = wrap_us(now_us_)});
    answered_us_ = now_us_;
    coasting_ = false;
  }

 private:
  using Group = SampleGroup<messages::SlaveImuDeltaTheta, messages::SlaveImuDeltaV, messages::SlaveImuStatus>;

  static constexpr double us = 1e-6;
  static constexpr std::int64_t bridge_limit_us = 200'000;   // a longer gap ends the run
  static constexpr std::int64_t most_parts = 400;            // increments that bridge one gap, in one call
  static constexpr std::int64_t silence_limit_us = 500'000;  // a longer silence of the IMU is an error

  template <class Message, class Step, class Reached>
  Health put(const Frame& frame, std::uint8_t counter, Context& context, const Step& step,
             const Reached& reached) {
    if (completes<Message>(group_, frame, counter, context)) return on_group(context, step, reached);
    return Health::good;
  }

  template <class Step, class Reached>
  Health on_group(Context& context, const Step& step, const Reached& reached) {
    const auto& theta = group_.template get<messages::SlaveImuDeltaTheta>();
    const auto& velocity = group_.template get<messages::SlaveImuDeltaV>();
    const auto& status = group_.template get<messages::SlaveImuStatus>();
    const strapdown::ImuIncrement imu{
        .delta_theta = {theta.delta_theta_x_rad, theta.delta_theta_y_rad, theta.delta_theta_z_rad},
        .delta_v = {velocity.delta_v_x_mps, velocity.delta_v_y_mps, velocity.delta_v_z_mps},
        .dt = status.interval_us * us};
    const std::int64_t t_us = unwrap_us(status.time_of_validity_us, context.now_us);
    if (theta.gyro_validity != messages::Validity::valid ||
        velocity.accel_validity != messages::Validity::valid || !(imu.dt > 0)) {
      drop_group(context);  // the gap is bridged when the next group arrives
      return Health::good;
    }
    const auto interval_us = static_cast<std::int64_t>(status.interval_us);
    const std::int64_t gap_us = t_us - interval_us - now_us_;
    if (gap_us <= -interval_us / 2) {
      ++context.losses.late;
      return Health::good;
    }
    if (gap_us > bridge_limit_us) {
      context.errors.input_silent = true;
      return Health::fault;
    }
    interval_us_ = interval_us;
    if (gap_us >= interval_us / 2) {
      context.errors.input_lost = true;
      bridge(imu, gap_us, step);
    }
    take(imu, t_us, step);
    bridging_.take(imu);
    previous_ = imu;
    return reached();
  }

  // Bridges a gap with increments that are computed from the mean of the rates before and after the gap, and
  // that say how wrong they may be. The next answer is marked as coasting.
  template <class Step>
  void bridge(const strapdown::ImuIncrement& after, std::int64_t gap_us, const Step& step) {
    coasting_ = true;
    const std::int64_t missing =
        std::clamp<std::int64_t>((gap_us + interval_us_ / 2) / interval_us_, 1, most_parts);
    const bool first = !(previous_.dt > 0);
    const strapdown::ImuIncrement before = first ? after : previous_;
    const double dt = static_cast<double>(gap_us) * us / static_cast<double>(missing);
    const auto [theta, velocity] =
        bridging_.of_gap(static_cast<std::size_t>(missing), dt,
                         first ? strapdown::ImuIncrement{.dt = after.dt} : before, after);
    const strapdown::ImuIncrement mean{
        .delta_theta = (before.delta_theta / before.dt + after.delta_theta / after.dt) * (dt / 2),
        .delta_v = (before.delta_v / before.dt + after.delta_v / after.dt) * (dt / 2),
        .dt = dt,
        .delta_theta_variance = theta / static_cast<double>(missing),
        .delta_v_variance = velocity / static_cast<double>(missing)};
    const std::int64_t start_us = now_us_;
    for (std::int64_t i = 1; i <= missing; ++i) take(mean, start_us + gap_us * i / missing, step);
  }

  template <class Step>
  void take(const strapdown::ImuIncrement& imu, std::int64_t t_us, const Step& step) {
    step(imu, t_us);
    now_us_ = t_us;
  }

  Group group_;
  std::int64_t now_us_ = 0;
  std::int64_t answered_us_ = 0;  // epoch of the last answer
  std::int64_t interval_us_ = 0;  // of the last sample
  strapdown::ImuIncrement previous_;
  BridgingError bridging_;
  bool coasting_ = false;
};

}  // namespace canhil::target
