#include "bench/sensors/fins.hpp"

#include <algorithm>
#include <array>

#include "bench/sensors/sampler.hpp"

namespace canhil::sensors {
namespace {

constexpr std::array<Output, 3> values{{{"elevator", "rad"}, {"aileron", "rad"}, {"rudder", "rad"}}};

NodeSettings read(const NodeTable& table, Section& section) {
  FinsSettings node;
  node.schedule = read_schedule(section);
  node.stamp_error_us =
      section.time_us({"time_stamp_error_ms", "Error of the time of validity that the frames carry."},
                      Limits::between(-200, 200), 0);
  node.loss = read_sample_loss(section);
  return {table, node};
}

class Fins final : public LossySampler<FinsSettings> {
 public:
  Fins(const NodeSettings& node, const Run& run)
      : LossySampler(node, run, "fins.loss"),
        truth_(world::PlantColumns<3>::find(
                   run.plants, {"plant.fins.elevator", "plant.fins.aileron", "plant.fins.rudder"})
                   .value()) {}

 private:
  void fill(std::int64_t t_us, Sample& sample) override {
    sample.stamp_us += config_.stamp_error_us;
    std::ranges::copy(*truth_.at(t_us), sample.values.begin());
  }

  world::PlantColumns<3> truth_;
};

}  // namespace

constinit const Kind fins{.key = "fins",
                          .samples = "plant.height",
                          .read = read,
                          .make = make<Fins>,
                          .outputs = {.values = values}};

}  // namespace canhil::sensors
