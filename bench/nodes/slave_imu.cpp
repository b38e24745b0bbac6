#include "bench/nodes/slave_imu.hpp"

#include "dbc/wire/time_base.hpp"

namespace canhil::nodes {
namespace {

using messages::SlaveImuDeltaTheta;
using messages::SlaveImuDeltaV;
using messages::SlaveImuStatus;
using messages::Validity;

constexpr std::int8_t temperature_degc = 25;  // the error model knows no temperature

}  // namespace

SlaveImu::SlaveImu(const world::FlightRecord& flight, const scenario::SlaveImu& config, world::Stream stream,
                   world::Stream losses)
    : flight_(flight),
      imu_(config.errors, stream),
      losses_(losses),
      loss_probability_(config.loss_probability),
      sampling_(flight.interval_us(), config.schedule.latency_us, flight.end_us()),
      theta_rounding_(SlaveImuDeltaTheta::signals()[0]),
      velocity_rounding_(SlaveImuDeltaV::signals()[0]) {}

void SlaveImu::transmit(Transmission& out) {
  const world::ImuIncrement measured = imu_.measure(flight_.increments()[next_]);
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
  if (losses_.uniform() < loss_probability_) out.clear();  // counted as sent: the receiver sees the gap
  ++next_;
  sampling_.advance();
}

}  // namespace canhil::nodes
