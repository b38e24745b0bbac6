#include "bench/sensors/start.hpp"

#include <algorithm>
#include <array>

#include "bench/sensors/kind.hpp"
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
class Start final : public Sensor {
 public:
  Start(const NodeSettings& node, const Run& run)
      : config_(*node.own<StartSettings>()),
        run_(run),
        stream_(run.stream("initial_error")),
        period_us_(node.period_us()),
        latency_us_(node.latency_us()) {}

  [[nodiscard]] std::int64_t due_us() const override {
    const std::int64_t due_us = sent_ * period_us_ + latency_us_;
    return sent_ == config_.times || due_us > run_.flight.end_us() ? never_us : due_us;
  }
  Sample measure() override {
    const std::int64_t t_us = sent_++ * period_us_;
    world::Stream stream = stream_;
    const world::NavigationSolution state =
        initial_solution(run_.flight.at(t_us), run_.scenario.initial_error, stream);
    const world::Euler angles = world::euler_from(state.C_bn);
    Sample sample{.valid_us = t_us, .stamp_us = t_us};
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
    return sample;
  }

 private:
  const StartSettings config_;
  const Run run_;
  const world::Stream stream_;
  std::int64_t period_us_, latency_us_;
  std::int64_t sent_ = 0;
};

}  // namespace

constinit const Kind start{.key = "start",
                           .samples = scenario::TruthOf::navigation,
                           .read = read,
                           .make = make<Start>,
                           .outputs = {.values = values},
                           .period_us = usual_period_us};

}  // namespace canhil::sensors
