// Plays the bench for tests of the Device: a level flight at constant velocity, sensors without errors.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "dbc/wire/time_base.hpp"
#include "dbc/wire/transmit.hpp"
#include "target/device/device.hpp"

namespace canhil::target {

/// Sends frames to a Device and stores its answers.
class BenchSide {
 public:
  template <class Message>
  void send(const Message& message) {
    out_.clear();
    out_.send(message);
    feed(out_.frames().front());
  }
  void feed(const Frame& frame) {
    fed_.push_back(frame);
    const auto answers = device_.receive(frame);
    answers_.insert(answers_.end(), answers.begin(), answers.end());
  }
  /// Increments the counter of a message without sending the message, so that the receiver detects a lost
  /// frame.
  template <class Message>
  void lose(const Message& message) {
    out_.clear();
    out_.send(message);
  }

  void command(messages::Command command,
               messages::Estimator estimator = messages::Estimator::transfer_alignment,
               messages::Algorithm algorithm = messages::Algorithm::kalman) {
    send(messages::TargetCommand{.command = command,
                                 .estimator = estimator,
                                 .algorithm = algorithm,
                                 .dbc_hash = messages::exchange_hash24(messages::name_of(estimator))});
  }
  void initialise() {
    send(messages::TargetInitLatitude{.latitude_deg = 37, .height_m = 1000});
    send(messages::TargetInitLongitude{.longitude_deg = 127, .position_sigma_m = 10});
    send(messages::TargetInitVelocityNE{.velocity_north_mps = speed, .velocity_east_mps = 0});
    send(messages::TargetInitAttitude{.roll_deg = 0, .pitch_deg = 0, .heading_deg = 0});
    send(messages::TargetInitSigma{.velocity_sigma_mps = 1, .tilt_sigma_deg = 1, .heading_sigma_deg = 1});
    send(messages::TargetInitVelocityD{.velocity_down_mps = 0, .time_of_validity_us = 0});
  }
  void start() {
    command(messages::Command::reset);
    initialise();
    command(messages::Command::start);
  }
  void sync(std::int64_t t_us, bool lockstep = false) {
    send(messages::Sync{.time_us = static_cast<std::uint64_t>(t_us),
                        .step = static_cast<std::uint16_t>(t_us / 10'000 % 2048),
                        .lockstep = static_cast<std::uint8_t>(lockstep)});
  }
  void imu(std::int64_t t_us, double interval_us = 10'000,
           messages::Validity validity = messages::Validity::valid) {
    send(theta(validity));
    send(velocity());
    send(status(t_us, interval_us));
  }
  void lose_imu(std::int64_t t_us) {
    lose(theta(messages::Validity::valid));
    lose(velocity());
    lose(status(t_us, 10'000));
  }
  void master(std::int64_t t_us, double north_mps = speed) {
    send(messages::MasterInsVelocityNE{.velocity_north_mps = north_mps,
                                       .velocity_east_mps = 0,
                                       .velocity_validity = messages::Validity::valid});
    send(messages::MasterInsAttitude{});
    send(messages::MasterInsLatitude{.latitude_deg = 37, .height_m = 1000});
    send(messages::MasterInsLongitude{.longitude_deg = 127});
    send(messages::MasterInsVelocityD{.velocity_down_mps = 0, .time_of_validity_us = wrap_us(t_us)});
  }

  static messages::SlaveImuDeltaTheta theta(messages::Validity validity) {
    return {.gyro_validity = validity};
  }
  static messages::SlaveImuDeltaV velocity() {
    return {.delta_v_z_mps = -9.798 * 0.01, .accel_validity = messages::Validity::valid};
  }
  static messages::SlaveImuStatus status(std::int64_t t_us, double interval_us) {
    return {.time_of_validity_us = wrap_us(t_us), .interval_us = interval_us, .temperature_degc = 20};
  }

  /// Answers of one type, in order, decoded.
  template <class Message>
  [[nodiscard]] std::vector<Message> all() const {
    std::vector<Message> found;
    for (const Frame& frame : answers_) {
      if (frame.id == Message::info.id) found.push_back(from_frame<Message>(frame));
    }
    return found;
  }
  template <class Message>
  [[nodiscard]] std::optional<Message> last() const {
    const auto found = all<Message>();
    return found.empty() ? std::nullopt : std::optional(found.back());
  }
  void forget() { answers_.clear(); }

  [[nodiscard]] Device& device() { return device_; }
  [[nodiscard]] const std::vector<Frame>& answers() const { return answers_; }
  [[nodiscard]] const std::vector<Frame>& fed() const { return fed_; }

  static constexpr double speed = 138.8;

 private:
  Device device_;
  Outbox<8> out_;
  std::vector<Frame> answers_;
  std::vector<Frame> fed_;
};

}  // namespace canhil::target
