#include "bench/sensors/depth_gauge.hpp"

#include <array>

#include "bench/sensors/constant_error.hpp"
#include "bench/sensors/sampler.hpp"

namespace canhil::sensors {
namespace {

constexpr std::array<Output, 1> values{{{"depth", "m"}}};
constexpr std::int64_t usual_period_us = 100'000;

NodeSettings read(const NodeTable& table, Section& section) {
  const Limits sigma = Limits::at_least(0);
  DepthGaugeSettings node;
  node.schedule = read_schedule(section);
  node.surface_height =
      section.number({"surface_height_m", "Height of the water's surface above the ellipsoid."}, {}, 0);
  node.below =
      section.number({"below_m", "Place of the gauge below the IMU, along the body's z axis."}, {}, 0);
  node.scale_factor =
      read_constant(section, "scale_factor_ppm", "the scale, such as a wrong density of the water");
  node.bias = read_constant(section, "bias_m", "the depth");
  node.noise = section.number({"noise_m", "White noise of the depth, 1-sigma of a sample."}, sigma, 0);
  node.loss = read_sample_loss(section);
  return {table, node};
}

class DepthGauge final : public LossySampler<DepthGaugeSettings> {
 public:
  DepthGauge(const NodeSettings& node, const Run& run)
      : LossySampler(node, run, "depth_gauge.loss"),
        stream_(run.stream("depth_gauge")),
        scale_(1 + draw(config_.scale_factor, stream_)),
        bias_(draw(config_.bias, stream_)) {}

 private:
  void fill(std::int64_t t_us, Sample& sample) override {
    const world::Truth truth = run_.flight.at(t_us);
    const double gauge = config_.surface_height - truth.position.height + config_.below * truth.C_bn(2, 2);
    sample.values = {scale_ * gauge + bias_ + config_.noise * stream_.normal()};
  }

  world::Stream stream_;
  double scale_, bias_;
};

}  // namespace

constinit const Kind depth_gauge{.key = "depth_gauge",
                                 .read = read,
                                 .make = make<DepthGauge>,
                                 .outputs = {.values = values},
                                 .period_us = usual_period_us};

}  // namespace canhil::sensors
