#include "bench/sensors/master_ins.hpp"

#include <array>

#include "bench/sensors/sampler.hpp"

namespace canhil::sensors {
namespace {

constexpr std::array<Output, 9> values{{{"velocity_north", "m/s"},
                                        {"velocity_east", "m/s"},
                                        {"roll", "rad", true},
                                        {"pitch", "rad", true},
                                        {"heading", "rad", true},
                                        {"latitude", "rad"},
                                        {"height", "m"},
                                        {"longitude", "rad", true},
                                        {"velocity_down", "m/s"}}};
constexpr std::array<std::string_view, 1> flags{"velocity"};

NodeSettings read(const NodeTable& table, Section& section) {
  const Limits sigma = Limits::at_least(0);
  MasterInsSettings node;
  node.schedule = read_schedule(section);
  node.errors = {
      .position = {.value = section.three({"position_bias_m", "Constant error of the position."}),
                   .sigma = section.three(
                       {"position_noise_m", "White noise of the position, 1-sigma of a sample."}, sigma)},
      .velocity = {.value = section.three({"velocity_bias_mps", "Constant error of the velocity."}),
                   .sigma = section.three(
                       {"velocity_noise_mps", "White noise of the velocity, 1-sigma of a sample."}, sigma)},
      .attitude = {
          .value = section.three({"attitude_bias_deg", "Constant error of the attitude."},
                                 Limits::between(-180, 180)),
          .sigma = section.three({"attitude_noise_deg", "White noise of the attitude, 1-sigma of a sample."},
                                 Limits::between(0, 180))}};
  node.loss = read_sample_loss(section);
  return {table, node};
}

class MasterIns final : public LossySampler<MasterInsSettings> {
 public:
  MasterIns(const NodeSettings& node, const Run& run)
      : LossySampler(node, run, "master_ins.loss"), stream_(run.stream("master_ins")) {}

 private:
  void fill(std::int64_t t_us, Sample& sample) override {
    const world::NavigationSolution solution = world::measure(run_.flight.at(t_us), config_.errors, stream_);
    const world::Euler angles = world::euler_from(solution.C_bn);
    sample.values = {solution.v_eb_n.x(),
                     solution.v_eb_n.y(),
                     angles.roll,
                     angles.pitch,
                     angles.heading,
                     solution.position.latitude,
                     solution.position.height,
                     solution.position.longitude,
                     solution.v_eb_n.z()};
  }

  world::Stream stream_;
};

}  // namespace

constinit const Kind master_ins{.key = "master_ins",
                                .read = read,
                                .make = make<MasterIns>,
                                .outputs = {.values = values, .flags = flags}};

}  // namespace canhil::sensors
