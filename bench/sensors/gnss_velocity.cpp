#include "bench/sensors/gnss_velocity.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/sensors/constant_error.hpp"
#include "bench/sensors/sampler.hpp"
#include "bench/world/correlated_noise.hpp"
#include "bench/world/mounting.hpp"

namespace canhil::sensors {
namespace {

using world::Vector3;

constexpr std::array<Output, 6> values{{{"north", "m/s"},
                                        {"east", "m/s"},
                                        {"down", "m/s"},
                                        {"ground_speed", "m/s"},
                                        {"course", "rad", true},
                                        {"sigma", "m/s"}}};
constexpr std::array<std::string_view, 1> flags{"velocity"};
constexpr std::int64_t usual_period_us = 200'000;

NodeSettings read(const NodeTable& table, Section& section) {
  const Limits sigma = Limits::at_least(0);
  GnssVelocitySettings node;
  node.schedule = read_schedule(section);
  node.lever_arm = read_lever_arm(section, "the antenna");
  node.bias = read_constants(section, "bias_mps", "the velocity, [N, E, D]");
  node.noise = section.three({"noise_mps", "White noise of the velocity, 1-sigma of a sample."}, sigma);
  node.correlated = section.number(
      {"correlated_mps", "1-sigma of an error of each axis that is correlated in time (Gauss-Markov)."},
      sigma, 0);
  node.correlation_s =
      section.number({"correlation_s", "Its correlation time."}, Limits::above(0), node.correlation_s);
  node.invalid_probability = section.number(
      {"invalid_percent", "Share of the samples without a solution. They are marked as invalid."},
      Limits::between(0, 100), 0);
  node.loss = read_sample_loss(section);
  return {table, node};
}

class GnssVelocity final : public LossySampler<GnssVelocitySettings> {
 public:
  GnssVelocity(const NodeSettings& node, const Run& run)
      : LossySampler(node, run, "gnss_velocity.loss"),
        stream_(run.stream("gnss_velocity")),
        bias_(draw(config_.bias, stream_)),
        correlated_(1, config_.correlation_s, 1e-6 * static_cast<double>(node.period_us()), stream_) {}

 private:
  void fill(std::int64_t t_us, Sample& sample) override {
    const world::Truth truth = run_.flight.at(t_us);
    const Vector3 antenna = world::velocity_at(truth, config_.lever_arm);
    const Vector3 correlated = config_.correlated * correlated_.next(stream_);
    Vector3 v = antenna + bias_ + correlated + config_.noise.cwiseProduct(stream_.normal3());
    const bool invalid = losses_.uniform() < config_.invalid_probability;
    if (invalid) v.setZero();
    const double sigma = std::hypot(std::max(config_.noise.x(), config_.noise.y()), config_.correlated);
    sample.values = {v.x(), v.y(), v.z(), std::hypot(v.x(), v.y()), std::atan2(v.y(), v.x()), sigma};
    sample.invalid = invalid ? 1 : 0;
  }

  world::Stream stream_;
  Vector3 bias_;
  world::CorrelatedNoise correlated_;
};

}  // namespace

constinit const Kind gnss_velocity{.key = "gnss_velocity",
                                   .read = read,
                                   .make = make<GnssVelocity>,
                                   .outputs = {.values = values, .flags = flags},
                                   .period_us = usual_period_us};

}  // namespace canhil::sensors
