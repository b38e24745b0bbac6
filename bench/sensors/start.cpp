#include "bench/sensors/start.hpp"

#include <array>

#include "bench/sensors/sampler.hpp"
#include "bench/world/navigation_errors.hpp"

namespace canhil::sensors {
namespace {

constexpr std::array<Output, 13> values{{{"latitude", "rad"},
                                         {"longitude", "rad", true},
                                         {"height", "m"},
                                         {"velocity_north", "m/s"},
                                         {"velocity_east", "m/s"},
                                         {"velocity_down", "m/s"},
                                         {"roll", "rad", true},
                                         {"pitch", "rad"},
                                         {"heading", "rad", true},
                                         {"position_sigma", "m"},
                                         {"velocity_sigma", "m/s"},
                                         {"tilt_sigma", "rad"},
                                         {"heading_sigma", "rad"}}};
constexpr std::int64_t usual_period_us = 100'000;

NodeSettings read(const NodeTable& table, Section& section) {
  const Limits sigma = Limits::at_least(0), angle = Limits::between(0, 180);
  StartSettings node;
  node.schedule = read_schedule(section);
  node.times = section.optional_integer({"times", "How often the state is sent, from 0 s on; default 1."}, 1)
                   .value_or(1);
  node.position_sigma =
      section.number({"position_sigma_m", "1-sigma of the position that the device is told."}, sigma, 0);
  node.velocity_sigma =
      section.number({"velocity_sigma_mps", "1-sigma of the velocity that the device is told."}, sigma, 0);
  node.tilt_sigma =
      section.number({"tilt_sigma_deg", "1-sigma of roll and pitch that the device is told."}, angle, 0);
  node.heading_sigma =
      section.number({"heading_sigma_deg", "1-sigma of the heading that the device is told."}, angle, 0);
  return {table, node};
}

// All samples have the same errors: somebody measured the state once.
class Start final : public Sampler<StartSettings> {
 public:
  Start(const NodeSettings& node, const Run& run)
      : Sampler(node, run, 0, node.own<StartSettings>()->times - 1), stream_(run.stream("initial_error")) {}

 private:
  bool take(std::int64_t t_us, Sample& sample) override {
    world::Stream stream = stream_;
    const world::NavigationSolution state =
        initial_solution(run_.flight.at(t_us), run_.scenario.initial_error, stream);
    const world::Euler angles = world::euler_from(state.C_bn);
    sample.values = {state.position.latitude,
                     state.position.longitude,
                     state.position.height,
                     state.v_eb_n.x(),
                     state.v_eb_n.y(),
                     state.v_eb_n.z(),
                     angles.roll,
                     angles.pitch,
                     angles.heading,
                     config_.position_sigma,
                     config_.velocity_sigma,
                     config_.tilt_sigma,
                     config_.heading_sigma};
    return true;
  }

  const world::Stream stream_;
};

}  // namespace

constinit const Kind start{.key = "start",
                           .read = read,
                           .make = make<Start>,
                           .outputs = {.values = values},
                           .period_us = usual_period_us};

}  // namespace canhil::sensors
