#include "bench/nodes/master_ins.hpp"

#include "bench/nodes/sample_loss.hpp"
#include "bench/world/units.hpp"
#include "dbc/wire/time_base.hpp"

namespace canhil::nodes {

using world::units::deg;

MasterIns::MasterIns(const world::FlightRecord& flight, const scenario::MasterIns& config,
                     world::Stream stream, world::Stream losses)
    : flight_(flight),
      errors_(config.errors),
      loss_(config.loss),
      stream_(stream),
      losses_(losses),
      sampling_(config.schedule.period_us.value_or(messages::MasterInsVelocityD::info.cycle_time_us),
                config.schedule.latency_us, flight.end_us()) {}

void MasterIns::transmit(Transmission& out) {
  const world::NavigationSolution solution = measure(flight_.at(sampling_.valid_us()), errors_, stream_);
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
                                        .time_of_validity_us = wrap_us(sampling_.valid_us())});
  if (is_lost(loss_, sampling_.valid_us(), losses_))
    out.clear();  // counted as sent: the receiver sees the gap
  sampling_.advance();
}

}  // namespace canhil::nodes
