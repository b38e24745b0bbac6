#include "bench/sensors/wheels.hpp"

#include <array>
#include <cmath>

#include "bench/sensors/constant_error.hpp"
#include "bench/sensors/sampler.hpp"

namespace canhil::sensors {
namespace {

constexpr std::array<Output, 4> values{
    {{"front_left", "m/s"}, {"front_right", "m/s"}, {"rear_left", "m/s"}, {"rear_right", "m/s"}}};
constexpr std::int64_t usual_period_us = 20'000;

NodeSettings read(const NodeTable& table, Section& section) {
  const Limits sigma = Limits::at_least(0);
  WheelsSettings node;
  node.schedule = read_schedule(section);
  node.track = section.number({"track_m", "Distance of the left from the right wheels."},
                              Limits::above(0, 10), node.track);
  node.scale_factor = read_constant(section, "scale_factor_ppm", "the radius of all wheels");
  node.noise = section.number({"noise_mps", "White noise of each speed, 1-sigma of a sample."}, sigma, 0);
  node.with_sign =
      section.flag({"with_sign",
                    "`true`: a wheel that turns backwards has a negative speed. `false`: the sensor "
                    "counts pulses and tells the magnitude only."});
  node.loss = read_sample_loss(section);
  return {table, node};
}

// A wheel rolls without slip along the body's x axis. At the distance y to the right of the middle it has the
// speed v_x - omega_z y (the velocity of a point of a rigid body). The steering angle of the front wheels is
// neglected.
class Wheels final : public LossySampler<WheelsSettings> {
 public:
  Wheels(const NodeSettings& node, const Run& run)
      : LossySampler(node, run, "wheels.loss"),
        stream_(run.stream("wheels")),
        scale_(1 + draw(config_.scale_factor, stream_)) {}

 private:
  void fill(std::int64_t t_us, Sample& sample) override {
    const world::Truth truth = run_.flight.at(t_us);
    const double forward = (truth.C_bn.transpose() * truth.v_eb_n).x();
    const double turn = truth.omega_ib_b.z() * config_.track / 2;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const bool is_left = i % 2 == 0;
      const double speed = scale_ * (forward + (is_left ? turn : -turn)) + config_.noise * stream_.normal();
      sample.values[i] = config_.with_sign ? speed : std::abs(speed);
    }
  }

  world::Stream stream_;
  double scale_;
};

}  // namespace

constinit const Kind wheels{.key = "wheels",
                            .read = read,
                            .make = make<Wheels>,
                            .outputs = {.values = values},
                            .period_us = usual_period_us};

}  // namespace canhil::sensors
