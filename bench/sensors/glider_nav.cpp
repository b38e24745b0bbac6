#include "bench/sensors/glider_nav.hpp"

#include <array>

#include "bench/sensors/constant_error.hpp"
#include "bench/sensors/sampler.hpp"
#include "bench/world/correlated_noise.hpp"

namespace canhil::sensors {
namespace {

using world::Vector3;

constexpr std::array<Output, 10> values{{{"velocity_north", "m/s"},
                                         {"velocity_east", "m/s"},
                                         {"height", "m"},
                                         {"roll", "rad", true},
                                         {"pitch", "rad", true},
                                         {"heading", "rad", true},
                                         {"rate_x", "rad/s"},
                                         {"rate_y", "rad/s"},
                                         {"rate_z", "rad/s"},
                                         {"velocity_down", "m/s"}}};
constexpr std::array<std::string_view, 1> flags{"navigation"};

NodeSettings read(const NodeTable& table, Section& section) {
  const Limits sigma = Limits::at_least(0);
  GliderNavSettings node;
  node.schedule = read_schedule(section);
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
  node.velocity_bias = read_constants(section, "velocity_bias_mps", "the velocity, [N, E, D]");
  node.attitude_bias = read_constants(section, "attitude_bias_deg", "roll, pitch and heading");
  node.loss = read_sample_loss(section);
  return {table, node};
}

class GliderNav final : public LossySampler<GliderNavSettings> {
 public:
  GliderNav(const NodeSettings& node, const Run& run)
      : LossySampler(node, run, "glider_nav.loss"),
        truth_(world::PlantColumns<10>::find(run.plants, names).value()),
        stream_(run.stream("glider_nav")),
        velocity_(noise(node)),
        rates_(noise(node)),
        attitude_(noise(node)) {
    world::Stream biases = run.stream("glider_nav.bias");
    velocity_bias_ = world::draw(config_.velocity_bias, biases);
    attitude_bias_ = world::draw(config_.attitude_bias, biases);
  }

 private:
  world::CorrelatedNoise noise(const NodeSettings& node) {
    return {config_.correlated_fraction, config_.correlation_time,
            1e-6 * static_cast<double>(node.period_us()), stream_};
  }
  void fill(std::int64_t t_us, Sample& sample) override {
    const auto truth = *truth_.at(t_us);
    const Vector3 velocity = Vector3(truth[0], truth[1], truth[9]) + velocity_bias_ +
                             config_.velocity_noise * velocity_.next(stream_);
    const Vector3 rates = Vector3(truth[6], truth[7], truth[8]) + config_.rate_noise * rates_.next(stream_);
    const Vector3 angles = Vector3(truth[3], truth[4], truth[5]) + attitude_bias_ +
                           config_.attitude_noise * attitude_.next(stream_);
    sample.values = {velocity.x(), velocity.y(), truth[2],  angles.x(), angles.y(),
                     angles.z(),   rates.x(),    rates.y(), rates.z(),  velocity.z()};
  }

  // In the order of `values`.
  static constexpr world::PlantColumns<10>::Names names{
      "velocity.north",   "velocity.east",     "plant.height",      "attitude.roll",     "attitude.pitch",
      "attitude.heading", "plant.body_rate.x", "plant.body_rate.y", "plant.body_rate.z", "velocity.down"};

  world::PlantColumns<10> truth_;
  world::Stream stream_;
  world::CorrelatedNoise velocity_;
  world::CorrelatedNoise rates_;
  world::CorrelatedNoise attitude_;
  Vector3 velocity_bias_, attitude_bias_;
};

}  // namespace

constinit const Kind glider_nav{.key = "glider_nav",
                                .samples = "plant.height",
                                .read = read,
                                .make = make<GliderNav>,
                                .outputs = {.values = values, .flags = flags}};

}  // namespace canhil::sensors
