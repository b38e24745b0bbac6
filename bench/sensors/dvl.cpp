#include "bench/sensors/dvl.hpp"

#include <array>

#include "bench/sensors/constant_error.hpp"
#include "bench/sensors/sampler.hpp"
#include "bench/world/mounting.hpp"

namespace canhil::sensors {
namespace {

using world::Vector3;

constexpr std::array<Output, 3> values{{{"velocity_x", "m/s"}, {"velocity_y", "m/s"}, {"velocity_z", "m/s"}}};
constexpr std::array<std::string_view, 1> flags{"velocity"};
constexpr std::int64_t usual_period_us = 200'000;

NodeSettings read(const NodeTable& table, Section& section) {
  const Limits sigma = Limits::at_least(0);
  DvlSettings node;
  node.schedule = read_schedule(section);
  node.lever_arm = read_lever_arm(section, "the DVL");
  node.mounting = read_mounting(section, "the DVL");
  node.scale_factor = read_constant(section, "scale_factor_ppm", "the scale of all axes");
  node.bias = read_constants(section, "bias_mps", "the velocity along the DVL's axes [x, y, z]");
  node.noise = section.three({"noise_mps", "White noise of the velocity, 1-sigma of a sample."}, sigma);
  node.invalid_probability = section.number(
      {"invalid_percent", "Share of the samples without bottom lock. They are marked as invalid."},
      Limits::between(0, 100), 0);
  node.loss = read_sample_loss(section);
  return {table, node};
}

class Dvl final : public LossySampler<DvlSettings> {
 public:
  Dvl(const NodeSettings& node, const Run& run)
      : LossySampler(node, run, "dvl.loss"),
        stream_(run.stream("dvl")),
        scale_(1 + draw(config_.scale_factor, stream_)),
        bias_(draw(config_.bias, stream_)) {
    world::Stream mounting = run.stream("dvl.mounting");
    C_bs_ = world::mounted(draw(config_.mounting, mounting));
  }

 private:
  void fill(std::int64_t t_us, Sample& sample) override {
    const world::Truth truth = run_.flight.at(t_us);
    const world::Matrix3 C_ns = C_bs_ * truth.C_bn.transpose();
    Vector3 velocity = scale_ * (C_ns * world::velocity_at(truth, config_.lever_arm)) + bias_ +
                       config_.noise.cwiseProduct(stream_.normal3());
    const bool invalid = losses_.uniform() < config_.invalid_probability;
    if (invalid) velocity.setZero();
    sample.values = {velocity.x(), velocity.y(), velocity.z()};
    sample.invalid = invalid ? 1 : 0;
  }

  world::Stream stream_;
  double scale_;
  Vector3 bias_;
  world::Matrix3 C_bs_;  // from body axes to the DVL's
};

}  // namespace

constinit const Kind dvl{.key = "dvl",
                         .read = read,
                         .make = make<Dvl>,
                         .outputs = {.values = values, .flags = flags},
                         .period_us = usual_period_us};

}  // namespace canhil::sensors
