#include "tests/fifth_estimator/barometer.hpp"

#include "bench/nodes/sampler.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::nodes {
namespace {

NodeSettings read(const NodeTable& table, Section& section) {
  BarometerSettings node;
  node.schedule = read_schedule(section);
  node.noise = section.number({"noise_m", "White noise of the height, 1-sigma of a sample."},
                              Limits::between(0, 100), 0);
  node.loss = read_sample_loss(section);
  return {table, node};
}

class Barometer final : public Sampler<BarometerSettings> {
 public:
  Barometer(const NodeSettings& node, const Run& run)
      : Sampler(node, run), stream_(run.stream("barometer")), losses_(run.stream("barometer.loss")) {}

 private:
  bool sample(std::int64_t t_us, Transmission& out) override {
    const double height = run_.flight.at(t_us).position.height;
    out.send(messages::BarometerHeight{.height_m = height + config_.noise * stream_.normal(),
                                       .time_of_validity_us = wrap_us(t_us)});
    return !is_lost(config_.loss, t_us, losses_);
  }

  world::Stream stream_;
  world::Stream losses_;  // a separate stream: losses do not change measurements
};

}  // namespace

constinit const Kind barometer{.table = {.key = "barometer",
                                         .closes = messages::BarometerHeight::info,
                                         .samples = scenario::TruthOf::navigation,
                                         .read = read},
                               .make = make<Barometer>};

}  // namespace canhil::nodes
