// The part of the reception fuzzer that takes the place of the bench: it performs the handshake and sends the
// samples of sensors on a plausible flight. The input can change the sensors' frames. Unchanged frames are
// always correct, because the project's own code packs them and adds counter and CRC.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "dbc/wire/time_base.hpp"
#include "dbc/wire/transmit.hpp"
#include "target/device/device.hpp"
#include "tests/fuzz/script.hpp"

namespace canhil::fuzz {

/// How the input changes the messages of one group before the device receives them.
struct Spoil {
  enum Flag : std::uint8_t { lose_one = 1, wrong_crc = 2, twice = 4 };

  std::uint8_t flags = 0;
  std::uint8_t which = 0;  ///< index of the changed message in the group, modulo the number of messages
  std::uint8_t place = 0;  ///< index of the changed byte, modulo the number of bytes
  std::uint8_t bits = 0;   ///< bits to invert in this byte, before counter and CRC are written

  static Spoil read(Script& script) {
    const std::uint8_t first = script.byte();
    return {.flags = static_cast<std::uint8_t>(first & 0x0FU),
            .which = static_cast<std::uint8_t>(first >> 4U),
            .place = script.byte(),
            .bits = script.byte()};
  }
};

/// `Feed`: a function that is called with each frame.
template <class Feed>
class Bench {
 public:
  explicit Bench(Feed feed) : feed_(feed) {}

  std::int64_t t_us = 0;  ///< the bench's time
  bool lockstep = false;

  void feed(const Frame& frame) { feed_(frame); }

  /// Sends the messages of a group with the changes in `spoil`.
  template <class... Messages>
  void send(const Spoil& spoil, const Messages&... messages) {
    std::size_t index = 0;
    (send_one(spoil, index++ == spoil.which % sizeof...(Messages), messages), ...);
  }

  void command(messages::Command command, messages::Estimator estimator, messages::Algorithm algorithm) {
    send({}, messages::TargetCommand{.command = command,
                                     .estimator = estimator,
                                     .algorithm = algorithm,
                                     .dbc_hash = messages::exchange_hash24(messages::name_of(estimator))});
  }
  void set(messages::Parameter parameter, double value) {
    send({}, messages::ParamSet{.parameter = parameter, .value = static_cast<float>(value)});
  }
  void sync() {
    send({}, messages::Sync{.time_us = static_cast<std::uint64_t>(t_us),
                            .step = static_cast<std::uint16_t>(t_us / 10'000 % 2048),
                            .lockstep = static_cast<std::uint8_t>(lockstep)});
  }
  void initialise(const Spoil& spoil) {
    using namespace messages;
    send(spoil, TargetInitLatitude{.latitude_deg = latitude(t_us), .height_m = height},
         TargetInitLongitude{.longitude_deg = longitude, .position_sigma_m = 10},
         TargetInitVelocityNE{.velocity_north_mps = speed, .velocity_east_mps = 0}, TargetInitAttitude{},
         TargetInitSigma{.velocity_sigma_mps = 1, .tilt_sigma_deg = 1, .heading_sigma_deg = 5},
         TargetInitVelocityD{.velocity_down_mps = 0, .time_of_validity_us = wrap_us(t_us)});
  }
  void initialise_air(const Spoil& spoil) {
    send(spoil, messages::TargetInitRate{}, messages::TargetInitAirVelocity{.air_velocity_x_mps = speed});
  }

  /// Sends a sample of the estimator's main sensor (IMU, seeker or navigation). The sample is valid at t_us,
  /// and `interval_us` is the time since the previous sample.
  void drive(messages::Estimator estimator, const Spoil& spoil, std::int64_t interval_us) {
    switch (estimator) {
      case messages::Estimator::transfer_alignment:
      case messages::Estimator::inflight_alignment:
        return imu(spoil, interval_us);
      case messages::Estimator::los_rate:
        return seeker(spoil, interval_us);
      case messages::Estimator::wind:
        return glider(spoil, t_us);
      default:
        break;
    }
  }
  /// Sends the estimator's aiding measurement (master INS, fix or fins), which is valid at `valid_us`.
  void aid(messages::Estimator estimator, const Spoil& spoil, std::int64_t valid_us, bool gps) {
    switch (estimator) {
      case messages::Estimator::transfer_alignment:
        return master(spoil, valid_us);
      case messages::Estimator::inflight_alignment:
        return gps ? fix_gps(spoil, valid_us) : fix_ssbl(spoil, valid_us);
      case messages::Estimator::wind:
        return fins(spoil, valid_us);
      default:
        break;
    }
  }

 private:
  static constexpr double speed = 150, height = 5000, longitude = 179.99;
  static constexpr double us = 1e-6;
  static constexpr auto valid = messages::Validity::valid;

  static double latitude(std::int64_t at_us) { return 37 + speed * us * static_cast<double>(at_us) / 111e3; }

  template <class Message>
  void send_one(const Spoil& spoil, bool chosen, const Message& message) {
    Frame frame = to_frame(message, counters_.template take<Message>());
    if (chosen) {
      if ((spoil.flags & Spoil::lose_one) != 0) return;
      const std::size_t place = 1 + spoil.place % (Message::size - 1);
      frame.data[place] ^= place == 1 ? spoil.bits & 0xF0U : spoil.bits;
      e2e::protect({frame.data.data(), Message::size}, Message::info.e2e_data_id, frame.data[1] & 0x0FU);
      if ((spoil.flags & Spoil::wrong_crc) != 0) frame.data[0] ^= 1U;
      if ((spoil.flags & Spoil::twice) != 0) feed_(frame);
    }
    feed_(frame);
  }

  void imu(const Spoil& spoil, std::int64_t interval_us) {
    using namespace messages;
    const double gravity = 9.78 * us * static_cast<double>(interval_us);
    send(spoil, SlaveImuDeltaTheta{.gyro_validity = valid},
         SlaveImuDeltaV{.delta_v_z_mps = -gravity, .accel_validity = valid},
         SlaveImuStatus{.time_of_validity_us = wrap_us(t_us),
                        .interval_us = static_cast<double>(interval_us),
                        .temperature_degc = 20});
  }
  void master(const Spoil& spoil, std::int64_t valid_us) {
    using namespace messages;
    send(spoil, MasterInsVelocityNE{.velocity_north_mps = speed, .velocity_validity = valid},
         MasterInsAttitude{}, MasterInsLatitude{.latitude_deg = latitude(valid_us), .height_m = height},
         MasterInsLongitude{.longitude_deg = longitude},
         MasterInsVelocityD{.time_of_validity_us = wrap_us(valid_us)});
  }
  void fix_ssbl(const Spoil& spoil, std::int64_t valid_us) {
    using namespace messages;
    send(spoil,
         SsblRelativeNE{.relative_north_m = speed * us * static_cast<double>(valid_us),
                        .position_validity = valid},
         SsblShipLatitude{.latitude_deg = latitude(0), .height_m = height},
         SsblShipLongitude{.longitude_deg = longitude},
         SsblRelativeD{.time_of_validity_us = wrap_us(valid_us)});
  }
  void fix_gps(const Spoil& spoil, std::int64_t valid_us) {
    using namespace messages;
    send(spoil, GpsLatitude{.latitude_deg = latitude(valid_us), .height_m = height},
         GpsLongitude{.longitude_deg = longitude, .satellites = 8, .position_validity = valid},
         GpsTime{.time_of_validity_us = wrap_us(valid_us)});
  }
  void seeker(const Spoil& spoil, std::int64_t interval_us) {
    using namespace messages;
    constexpr double closing = 900, first_range = 5000;
    const double flown = closing * us * static_cast<double>(t_us % 5'000'000);  // a new target every 5 s
    send(spoil, SeekerAntenna{.antenna_increment_yaw_rad = 1e-5, .antenna_validity = valid},
         SeekerAngles{.error_pitch_rad = 1e-3,
                      .interval_us = static_cast<double>(interval_us),
                      .error_validity = valid},
         SeekerMotion{
             .closing_speed_mps = closing, .acceleration_validity = valid, .closing_speed_validity = valid},
         SeekerRange{
             .range_m = first_range - flown, .time_of_validity_us = wrap_us(t_us), .range_validity = valid});
  }
  void fins(const Spoil& spoil, std::int64_t valid_us) {
    send(spoil,
         messages::FinDeflections{.elevator_deg = 0.5,
                                  .time_of_validity_us = static_cast<double>(wrap_short_us(valid_us))});
  }
  void glider(const Spoil& spoil, std::int64_t valid_us) {
    using namespace messages;
    alternating_ = -alternating_;  // the device treats a navigation solution that never changes as stale
    send(spoil, GliderNavVelocityNE{.velocity_north_mps = speed + alternating_, .height_m = height},
         GliderNavAttitude{.pitch_deg = 1.7, .navigation_validity = valid}, GliderNavRates{},
         GliderNavVelocityD{.velocity_down_mps = 0, .time_of_validity_us = wrap_us(valid_us)});
  }

  Feed feed_;
  TransmitCounters counters_;
  double alternating_ = 0.02;
};

}  // namespace canhil::fuzz
