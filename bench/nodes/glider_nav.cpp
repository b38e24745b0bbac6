#include "bench/nodes/glider_nav.hpp"

#include <cmath>

#include "bench/nodes/sampler.hpp"
#include "bench/world/correlated_noise.hpp"
#include "bench/world/units.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::nodes {
namespace {

using world::Vector3;
using world::units::deg;

// Wraps an angle to the range of its signal, -180 to 180 deg.
double angle_deg(double angle) { return std::remainder(angle / deg, 360); }

NodeSettings read(const NodeTable& table, Section& section) {
  const Limits sigma = Limits::at_least(0);
  GliderNavSettings node;
  node.schedule = read_glide_schedule(section);
  node.velocity_noise =
      section.number({"velocity_noise_mps", "White noise of the velocity, 1-sigma of a sample."}, sigma, 0);
  node.rate_noise =
      section.number({"rate_noise_degps", "White noise of the body rates, 1-sigma of a sample."}, sigma, 0);
  node.attitude_noise = section.number(
      {"attitude_noise_deg", "White noise of the attitude, 1-sigma of a sample."}, Limits::between(0, 45), 0);
  node.correlated_fraction =
      section.number({"correlated_fraction", "Share of the noise's variance that is correlated in time."},
                     Limits::between(0, 1), 0);
  node.correlation_time = section.number(
      {"correlation_time_s", "Correlation time of the correlated part of the noise (`correlated_fraction`)."},
      Limits::above(0), node.correlation_time);
  node.loss = read_sample_loss(section);
  return {table, node};
}

class GliderNav final : public Sampler<GliderNavSettings> {
 public:
  GliderNav(const NodeSettings& node, const Run& run)
      : Sampler(node, run),
        stream_(run.stream("glider_nav")),
        losses_(run.stream("glider_nav.loss")),
        period_s_(1e-6 * static_cast<double>(node.period_us())),
        velocity_(config_.correlated_fraction, config_.correlation_time, stream_),
        rates_(config_.correlated_fraction, config_.correlation_time, stream_),
        attitude_(config_.correlated_fraction, config_.correlation_time, stream_) {}

 private:
  bool sample(std::int64_t t_us, Transmission& out) override {
    const world::GlideTruth& truth = run_.glide->at(t_us);
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
    out.send(messages::GliderNavVelocityD{.velocity_down_mps = velocity.z(),
                                          .time_of_validity_us = wrap_us(t_us)});
    return !is_lost(config_.loss, t_us, losses_);
  }

  world::Stream stream_;
  world::Stream losses_;  // a separate stream: losses do not change measurements
  double period_s_;
  world::CorrelatedNoise velocity_;
  world::CorrelatedNoise rates_;
  world::CorrelatedNoise attitude_;
};

}  // namespace

constinit const Kind glider_nav{.table = {.key = "glider_nav",
                                          .closes = messages::GliderNavVelocityD::info,
                                          .samples = scenario::TruthOf::glide,
                                          .read = read},
                                .make = make<GliderNav>};

}  // namespace canhil::nodes
