#include "bench/nodes/glider_nav.hpp"

#include <cmath>

#include "bench/nodes/sample_loss.hpp"
#include "bench/world/units.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::nodes {
namespace {

using messages::GliderNavVelocityD;
using world::Vector3;
using world::units::deg;

std::int64_t period_us(const scenario::GliderNav& config) {
  return config.schedule.period_us.value_or(GliderNavVelocityD::info.cycle_time_us);
}

// Within the half turns that the bus carries.
double angle_deg(double angle) { return std::remainder(angle / deg, 360); }

}  // namespace

GliderNav::GliderNav(const world::GlideRecord& glide, const scenario::GliderNav& config, world::Stream stream,
                     world::Stream losses, std::int64_t end_us)
    : glide_(glide),
      config_(config),
      stream_(stream),
      losses_(losses),
      period_s_(1e-6 * static_cast<double>(period_us(config))),
      sampling_(period_us(config), config.schedule.latency_us, end_us),
      velocity_(config.correlated_fraction, config.correlation_time, stream_),
      rates_(config.correlated_fraction, config.correlation_time, stream_),
      attitude_(config.correlated_fraction, config.correlation_time, stream_) {}

void GliderNav::transmit(Transmission& out) {
  const std::int64_t t_us = sampling_.valid_us();
  const world::GlideTruth& truth = glide_.at(t_us);
  const Vector3 velocity = truth.v_eb_n + config_.velocity_noise * velocity_.next(period_s_, stream_);
  const Vector3 rates = truth.omega_nb_b + config_.rate_noise * rates_.next(period_s_, stream_);
  const Vector3 turn = config_.attitude_noise * attitude_.next(period_s_, stream_);
  const world::Euler angles = world::euler_from(truth.C_bn);
  out.send(messages::GliderNavVelocityNE{
      .velocity_north_mps = velocity.x(), .velocity_east_mps = velocity.y(), .height_m = truth.height});
  out.send(messages::GliderNavAttitude{.roll_deg = angle_deg(angles.roll + turn.x()),
                                       .pitch_deg = angle_deg(angles.pitch + turn.y()),
                                       .heading_deg = angle_deg(angles.heading + turn.z()),
                                       .navigation_validity = messages::Validity::valid});
  out.send(messages::GliderNavRates{
      .rate_x_degps = rates.x() / deg, .rate_y_degps = rates.y() / deg, .rate_z_degps = rates.z() / deg});
  out.send(GliderNavVelocityD{.velocity_down_mps = velocity.z(), .time_of_validity_us = wrap_us(t_us)});
  if (is_lost(config_.loss, t_us, losses_)) out.clear();  // counted as sent: the receiver sees the gap
  sampling_.advance();
}

}  // namespace canhil::nodes
