#include "bench/nodes/master_ins.hpp"

#include "bench/nodes/sampler.hpp"
#include "bench/world/units.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::nodes {
namespace {

using world::units::deg;

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

class MasterIns final : public Sampler<MasterInsSettings> {
 public:
  MasterIns(const NodeSettings& node, const Run& run)
      : Sampler(node, run), stream_(run.stream("master_ins")), losses_(run.stream("master_ins.loss")) {}

 private:
  bool sample(std::int64_t t_us, Transmission& out) override {
    const world::NavigationSolution solution = measure(run_.flight.at(t_us), config_.errors, stream_);
    const world::Euler angles = world::euler_from(solution.C_bn);
    out.send(messages::MasterInsVelocityNE{.velocity_north_mps = solution.v_eb_n.x(),
                                           .velocity_east_mps = solution.v_eb_n.y(),
                                           .velocity_validity = messages::Validity::valid});
    out.send(messages::MasterInsAttitude{
        .roll_deg = angles.roll / deg, .pitch_deg = angles.pitch / deg, .heading_deg = angles.heading / deg});
    out.send(messages::MasterInsLatitude{.latitude_deg = solution.position.latitude / deg,
                                         .height_m = solution.position.height});
    out.send(messages::MasterInsLongitude{.longitude_deg = world::longitude_deg(solution.position)});
    out.send(messages::MasterInsVelocityD{.velocity_down_mps = solution.v_eb_n.z(),
                                          .time_of_validity_us = wrap_us(t_us)});
    return !is_lost(config_.loss, t_us, losses_);
  }

  world::Stream stream_;
  world::Stream losses_;  // a separate stream: losses do not change measurements
};

}  // namespace

constinit const Kind master_ins{.table = {.key = "master_ins",
                                          .closes = messages::MasterInsVelocityD::info,
                                          .samples = scenario::TruthOf::navigation,
                                          .read = read},
                                .make = make<MasterIns>};

}  // namespace canhil::nodes
