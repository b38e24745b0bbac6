#include "bench/sensors/fins.hpp"

#include <array>

#include "bench/sensors/sampler.hpp"

namespace canhil::sensors {
namespace {

constexpr std::array<Output, 3> values{{{"elevator", "rad"}, {"aileron", "rad"}, {"rudder", "rad"}}};

NodeSettings read(const NodeTable& table, Section& section) {
  FinsSettings node;
  node.schedule = read_glide_schedule(section);
  node.stamp_error_us =
      section.time_us({"time_stamp_error_ms", "Error of the time of validity that the frames carry."},
                      Limits::between(-200, 200), 0);
  node.loss = read_sample_loss(section);
  return {table, node};
}

class Fins final : public LossySampler<FinsSettings> {
 public:
  Fins(const NodeSettings& node, const Run& run) : LossySampler(node, run, "fins.loss") {}

 private:
  void fill(std::int64_t t_us, Sample& sample) override {
    const world::glide::Fins& at = run_.glide->at(t_us).fins;
    sample.stamp_us += config_.stamp_error_us;
    sample.values = {at.x(), at.y(), at.z()};
  }
};

}  // namespace

constinit const Kind fins{.key = "fins",
                          .samples = scenario::TruthOf::glide,
                          .read = read,
                          .make = make<Fins>,
                          .outputs = {.values = values}};

}  // namespace canhil::sensors
