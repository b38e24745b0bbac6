#include "bench/nodes/fins.hpp"

#include "bench/nodes/sampler.hpp"
#include "bench/world/units.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::nodes {
namespace {

using world::units::deg;

NodeSettings read(const NodeTable& table, Section& section) {
  FinsSettings node;
  node.schedule = read_glide_schedule(section);
  node.stamp_error_us =
      section.time_us({"time_stamp_error_ms", "Error of the time of validity that the frames carry."},
                      Limits::between(-200, 200), 0);
  node.loss = read_sample_loss(section);
  return {table, node};
}

class Fins final : public Sampler<FinsSettings> {
 public:
  Fins(const NodeSettings& node, const Run& run) : Sampler(node, run), losses_(run.stream("fins.loss")) {}

 private:
  bool sample(std::int64_t t_us, Transmission& out) override {
    const world::glide::Fins& at = run_.glide->at(t_us).fins;
    const std::int64_t stamp_us = wrap_short_us(t_us + config_.stamp_error_us);
    out.send(messages::FinDeflections{.elevator_deg = at.x() / deg,
                                      .aileron_deg = at.y() / deg,
                                      .rudder_deg = at.z() / deg,
                                      .time_of_validity_us = static_cast<double>(stamp_us)});
    return !is_lost(config_.loss, t_us, losses_);
  }

  world::Stream losses_;
};

}  // namespace

constinit const Kind fins{.table = {.key = "fins",
                                    .closes = messages::FinDeflections::info,
                                    .samples = scenario::TruthOf::glide,
                                    .read = read},
                          .make = make<Fins>};

}  // namespace canhil::nodes
