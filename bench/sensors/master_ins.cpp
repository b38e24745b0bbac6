#include "bench/sensors/master_ins.hpp"

#include <algorithm>
#include <array>

#include "bench/sensors/error_stack.hpp"
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
constexpr std::string_view correlated_key = "velocity_correlated_mps",
                           correlation_key = "velocity_correlation_s";

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
  node.further = read_error_stacks(
      section,
      {.of = "the velocity, [N, E, D]", .correlated = correlated_key, .correlation = correlation_key});
  node.loss = read_sample_loss(section);
  return {table, node};
}

class MasterIns final : public LossySampler<MasterInsSettings> {
 public:
  MasterIns(const NodeSettings& node, const Run& run)
      : LossySampler(node, run, "master_ins.loss"),
        stream_(run.stream("master_ins")),
        further_(config_.further, 1e-6 * static_cast<double>(node.period_us()),
                 run.stream("master_ins.further")) {}

 private:
  void fill(std::int64_t t_us, Sample& sample) override {
    const world::NavigationSolution solution = world::measure(run_.flight.at(t_us), config_.errors, stream_);
    const world::Euler angles = world::euler_from(solution.C_bn);
    const world::Vector3 velocity = solution.v_eb_n + further_.wander();
    sample.values = {velocity.x(),
                     velocity.y(),
                     angles.roll,
                     angles.pitch,
                     angles.heading,
                     solution.position.latitude,
                     solution.position.height,
                     solution.position.longitude,
                     velocity.z()};
  }

  world::Stream stream_;
  world::TriadErrors further_;
};

std::vector<Stated> data_sheet(const NodeSettings& node) {
  const world::TriadErrors::Stacks& axes = node.own<MasterInsSettings>()->further;
  const double largest = std::max({axes[0].correlated, axes[1].correlated, axes[2].correlated});
  return {{correlated_key, largest}, {correlation_key, axes[0].correlation_s}};
}

}  // namespace

constinit const Kind master_ins{.key = "master_ins",
                                .read = read,
                                .make = make<MasterIns>,
                                .outputs = {.values = values, .flags = flags},
                                .data_sheet = data_sheet};

}  // namespace canhil::sensors
